// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::server {

// Keys of missions that were deleted and that their store has not forgotten yet. Thread-safe.
class RemovalList {
 public:
  void Add(const std::string& key) {
    absl::MutexLock lock(&mutex_);
    keys_.insert(key);
  }
  // The store has answered to one Add. REQUIRES: there was one.
  void Erase(const std::string& key) {
    absl::MutexLock lock(&mutex_);
    keys_.erase(keys_.find(key));
  }
  bool Contains(const std::string& key) const {
    absl::MutexLock lock(&mutex_);
    return keys_.contains(key);
  }

 private:
  mutable absl::Mutex mutex_;
  std::multiset<std::string> keys_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
