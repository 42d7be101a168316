// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::server {

// Starts the operations of a stream (read, write, finish) one after the other.
//
// gRPC may run the reaction to an operation inside the call that starts it, on whatever thread that
// is: an operation must not be started under a lock that reactions take. And nothing may be started
// after a finish, not even by a thread that decided so before: the stream may be gone.
class StreamPump {
 public:
  using Operation = std::function<void()>;

  // Runs what `next` decides under the lock, outside it, until `next` has nothing. A call that
  // finds the pump running leaves the work to it. REQUIRES: `mutex` is not held; the owner of both
  // stays alive meanwhile.
  void Run(absl::Mutex& mutex,
           const std::function<Operation()>& next) ABSL_NO_THREAD_SAFETY_ANALYSIS {
    mutex.Lock();
    if (!std::exchange(running_, true)) {
      while (const Operation operation = next()) {
        mutex.Unlock();
        operation();
        mutex.Lock();
      }
      running_ = false;
    }
    mutex.Unlock();
  }

 private:
  bool running_ = false;  // guarded by the mutex given to Run
};

}  // namespace plumescout::server
