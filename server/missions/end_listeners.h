// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::server {

// Those who want to hear that something ends, and why. Thread-safe.
class EndListeners {
 public:
  // Must not block.
  using Listener = std::function<void(const absl::Status&)>;
  using Id = std::int64_t;  // 0: of none

  // The listener is called once when End is, at once if it was.
  Id Add(Listener listener);
  // A call that is under way is not waited for. No effect if there is none of this id.
  void Remove(Id id);
  // The first status counts.
  void End(const absl::Status& status);

  int size() const;

 private:
  mutable absl::Mutex mutex_;
  std::map<Id, Listener> listeners_ ABSL_GUARDED_BY(mutex_);
  Id last_id_ ABSL_GUARDED_BY(mutex_) = 0;
  absl::Status end_ ABSL_GUARDED_BY(mutex_);  // OK until End
};

}  // namespace plumescout::server
