// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "proto/convert/map.h"
#include "server/base/worker_pool.h"
#include "server/maps/encoded_map.h"
#include "server/maps/map_store.h"

namespace plumescout::server {

// Somebody who watches a map.
class MapReader {
 public:
  virtual ~MapReader() = default;
  // Frames that follow on those taken before. Must not block.
  virtual void Take(std::shared_ptr<const MapFrames> frames) = 0;
  // No more frames come. Must not block.
  virtual void End(const absl::Status& status) = 0;
};

// The watchers of one mission's map. However many they are, it hears once of a new belief and has
// one task on the pool, which makes frames for all who wait. Who is slow waits for nothing: when he
// asks again he gets what brings him to the newest belief. If the pool is full, all wait for the
// next belief. Thread-safe; nothing blocks.
class MapFeed : public std::enable_shared_from_this<MapFeed> {
 public:
  using BeliefPtr = std::shared_ptr<const Belief>;
  // As MissionHost::Subscribe.
  using Subscriber = std::function<bool(absl::StatusOr<BeliefPtr>)>;
  using Subscribe = std::function<absl::Status(Subscriber)>;

  MapFeed(const MissionId& mission, std::int64_t max_part_bytes)
      : store_(mission, max_part_bytes) {}

  MapStore& store() { return store_; }

  // The reader gets the map of the present belief, and then of the newest whenever he waits. Frames
  // are made on `pool`, which outlives the feed's readers. An error: he did not join.
  absl::Status Join(const std::shared_ptr<MapReader>& reader, const MapView& view, WorkerPool* pool,
                    const Subscribe& subscribe) ABSL_LOCKS_EXCLUDED(mutex_);
  // The reader is done with the frames that he took.
  void Await(const MapReader* reader) ABSL_LOCKS_EXCLUDED(mutex_);
  void Leave(const MapReader* reader) ABSL_LOCKS_EXCLUDED(mutex_);
  int reader_count() const ABSL_LOCKS_EXCLUDED(mutex_);

 private:
  struct Place {
    std::weak_ptr<MapReader> reader;
    MapView view;
    WorkerPool* pool = nullptr;
    std::int64_t held = kHoldsNothing;  // the revision
    bool waits = true;
  };

  // Whether to go on telling: of all that listen, one does for all readers. `is_lasting`: that one.
  bool Update(absl::StatusOr<BeliefPtr> belief, bool& is_lasting) ABSL_LOCKS_EXCLUDED(mutex_);
  void EndAll(const absl::Status& status) ABSL_LOCKS_EXCLUDED(mutex_);
  bool IsBehind(const Place& place) const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void ServeSoon(WorkerPool* pool) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Serve() ABSL_LOCKS_EXCLUDED(mutex_);

  MapStore store_;

  mutable absl::Mutex mutex_;
  std::map<const MapReader*, Place> places_ ABSL_GUARDED_BY(mutex_);
  BeliefPtr newest_ ABSL_GUARDED_BY(mutex_);        // null: none since there are readers
  bool listens_ ABSL_GUARDED_BY(mutex_) = false;    // somebody tells of every belief
  bool is_queued_ ABSL_GUARDED_BY(mutex_) = false;  // a task that has not begun
};

}  // namespace plumescout::server
