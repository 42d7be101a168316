// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <random>
#include <string>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::client {

// Names requests, so that the server answers one that is sent again as it did the first time. A
// request whose answer was lost keeps its name for the next try; otherwise every request has one of
// its own, also one that is equal to an earlier. Thread-safe.
class RequestIds {
 public:
  // `content`: everything in the request but the name.
  std::string NameOf(const std::string& content);
  // How the call of that request ended. Only if it may have been carried out unknown to us is its
  // name kept.
  void NoteEnd(const std::string& content, const std::string& name, const absl::Status& status);

 private:
  struct Open {
    std::size_t content_hash = 0;
    std::string name;
  };

  absl::Mutex mutex_;
  std::mt19937_64 bits_ ABSL_GUARDED_BY(mutex_){std::random_device{}()};
  std::deque<Open> open_ ABSL_GUARDED_BY(mutex_);  // the oldest first
};

}  // namespace plumescout::client
