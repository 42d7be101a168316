// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "plumescout/v1/robot_service.pb.h"
#include "server/missions/robot_notices.h"
#include "server/streams/write_stream.h"

namespace plumescout::server {

// One watcher of a robot. It fetches a notice when the one before is on its way: a slow reader
// costs one message, never a queue.
class RobotWatchStream final : public WriteStream<v1::WatchRobotResponse>, public RobotWatcher {
 public:
  static RobotWatchStream* Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                                 const v1::WatchRobotRequest& request);

  explicit RobotWatchStream(const ServiceContext* context) : WriteStream(context) {}

  void End(const absl::Status& status) override { WriteStream::End(status); }
  void Wake() override { Pump(); }

 private:
  absl::Status Subscribe(const v1::WatchRobotRequest& request);
  // On the writer's thread.
  void Join(const RobotId& robot, std::optional<std::int64_t> lease_token, MissionWriter& writer);
  StreamPump::Operation NextOperation() override ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void LetGo() override;

  EndListeners::Id listener_ = 0;     // of the mission's end
  v1::WatchRobotResponse in_flight_;  // while it is being written
  // Until LetGo: whoever holds a mission uses it.
  std::shared_ptr<MissionHost> host_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
