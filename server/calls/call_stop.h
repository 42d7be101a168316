// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "server/calls/unary_call.h"
#include "server/missions/end_listeners.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

// Says whether work for a call is in vain: its caller has given up, its deadline has passed, or the
// mission or the server ends. Thread-safe.
class CallStop {
 public:
  CallStop(std::shared_ptr<UnaryCall> call, std::shared_ptr<MissionHost> host);
  ~CallStop() { host_->end_listeners().Remove(listener_); }
  CallStop(const CallStop&) = delete;
  CallStop& operator=(const CallStop&) = delete;

  bool stops() const { return !why().ok(); }
  // What to answer with: `status`, or why the work that came to it was cut short.
  absl::Status AnswerOf(const absl::Status& status) const;

 private:
  // The listener may be called when this is gone.
  struct Ending {
    absl::Mutex mutex;
    absl::Status status ABSL_GUARDED_BY(mutex);
  };

  absl::Status why() const;

  const std::shared_ptr<UnaryCall> call_;
  const std::shared_ptr<MissionHost> host_;
  const std::shared_ptr<Ending> ending_ = std::make_shared<Ending>();
  const EndListeners::Id listener_;
};

}  // namespace plumescout::server
