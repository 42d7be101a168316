// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/end_listeners.h"

#include <utility>

namespace plumescout::server {

EndListeners::Id EndListeners::Add(Listener listener) {
  absl::Status end;
  {
    absl::MutexLock lock(&mutex_);
    if (end_.ok()) {
      listeners_.emplace(++last_id_, std::move(listener));
      return last_id_;
    }
    end = end_;
  }
  listener(end);
  return 0;
}

void EndListeners::Remove(Id id) {
  std::map<Id, Listener>::node_type removed;  // what it holds goes outside the lock
  absl::MutexLock lock(&mutex_);
  removed = listeners_.extract(id);
}

void EndListeners::End(const absl::Status& status) {
  std::map<Id, Listener> told;
  absl::Status end;
  {
    absl::MutexLock lock(&mutex_);
    if (end_.ok()) end_ = status;
    end = end_;
    told.swap(listeners_);
  }
  for (const auto& [id, listener] : told) listener(end);
}

int EndListeners::size() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(listeners_.size());
}

}  // namespace plumescout::server
