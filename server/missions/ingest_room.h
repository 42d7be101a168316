// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "core/mission/conduct/ingest.h"

namespace plumescout::server {

// What a batch takes of the room, and how much of it there is.
struct IngestLoad {
  int observations = 0;
  std::int64_t bytes = 0;
};

IngestLoad LoadOf(const std::vector<IncomingObservation>& batch);

// The room that observations have which wait for a mission's writer, taken when they come and not
// before. A batch that is larger than all of the room gets it when nobody else has any.
// Thread-safe.
class IngestRoom : public std::enable_shared_from_this<IngestRoom> {
 public:
  // Room that was taken; given back when the last copy goes.
  using Hold = std::shared_ptr<const void>;
  // Must not block.
  using Granted = std::function<void(Hold)>;
  using Place = std::int64_t;  // among those who wait; 0: none

  // REQUIRES: owned by a shared_ptr.
  explicit IngestRoom(const IngestLoad& limit) : limit_(limit) {}

  // Null if there is no room, or somebody waits for it.
  Hold TryTake(const IngestLoad& load);
  // `granted` is called once there is room, perhaps before this returns, in the order in which they
  // asked.
  Place TakeOrWait(const IngestLoad& load, Granted granted);
  // Its `granted` will not be called, unless that has begun.
  void Withdraw(Place place);

  IngestLoad used() const;
  int waiting() const;

 private:
  struct Waiting {
    IngestLoad load;
    Granted granted;
  };

  bool Fits(const IngestLoad& load) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  Hold Take(const IngestLoad& load) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void GiveBack(const IngestLoad& load);
  // To those who wait, as far as it goes.
  void Grant();

  const IngestLoad limit_;
  mutable absl::Mutex mutex_;
  IngestLoad used_ ABSL_GUARDED_BY(mutex_);
  Place last_place_ ABSL_GUARDED_BY(mutex_) = 0;
  std::map<Place, Waiting> waiting_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
