// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/server_callback.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "plumescout/v1/robot_service.pb.h"
#include "server/calls/active_streams.h"
#include "server/calls/service_context.h"
#include "server/missions/robot_notices.h"
#include "server/streams/stream_pump.h"

namespace plumescout::server {

// One watcher of a robot. It fetches a notice when the one before is on its way: a slow reader
// costs one message, never a queue.
class RobotWatchStream final : public grpc::ServerWriteReactor<v1::WatchRobotResponse>,
                               public EndableStream,
                               public RobotWatcher,
                               public std::enable_shared_from_this<RobotWatchStream> {
 public:
  // The reactor owns itself until gRPC is done with it.
  static RobotWatchStream* Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                                 const v1::WatchRobotRequest& request);

  explicit RobotWatchStream(const ServiceContext* context) : context_(*context) {}

  void End(const absl::Status& status) override;
  void Wake() override { Pump(); }

  void OnWriteDone(bool ok) override;
  void OnCancel() override { End(absl::CancelledError("the caller gave up")); }
  void OnDone() override;

 private:
  absl::Status Subscribe(const v1::WatchRobotRequest& request);
  // On the writer's thread.
  void Join(const RobotId& robot, std::optional<std::int64_t> lease_token, MissionWriter& writer);
  // Starts whatever can start now: a write, or the finish.
  void Pump() ABSL_LOCKS_EXCLUDED(mutex_);
  StreamPump::Operation NextOperation() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const ServiceContext& context_;
  std::shared_ptr<RobotWatchStream> self_;  // until OnDone
  Visit visit_;
  EndListeners::Id listener_ = 0;     // of the mission's end
  v1::WatchRobotResponse in_flight_;  // while writing_

  absl::Mutex mutex_;
  StreamPump pump_;
  // Until OnDone: whoever holds a mission uses it.
  std::shared_ptr<MissionHost> host_ ABSL_GUARDED_BY(mutex_);
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
  std::optional<absl::Status> end_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
