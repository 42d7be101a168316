// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/robot_watch_stream.h"

#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/names.h"
#include "proto/convert/robot_notice.h"
#include "server/base/log.h"

namespace plumescout::server {

RobotWatchStream* RobotWatchStream::Start(const ServiceContext* context,
                                          grpc::CallbackServerContext* call,
                                          const v1::WatchRobotRequest& request) {
  const auto stream = std::make_shared<RobotWatchStream>(context);
  stream->Run(Rpc::kWatchRobot, *call, [stream, &request] { return stream->Subscribe(request); });
  return stream.get();
}

absl::Status RobotWatchStream::Subscribe(const v1::WatchRobotRequest& request) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMissionOf(visit_.caller(), name));
  std::optional<std::int64_t> lease_token;
  if (request.lease_token() != 0 || visit_.caller().role == Role::kRobot) {
    PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(name.robot, request.lease_token()));
    lease_token = request.lease_token();
  }
  {
    absl::MutexLock lock(&mutex_);
    host_ = host;
  }
  listener_ = host->end_listeners().Add([weak = weak_from_this()](const absl::Status& status) {
    if (const auto stream = weak.lock()) stream->End(status);
  });
  const auto self = shared_from_this();
  return host->Post([this, self, robot = name.robot,
                     lease_token](MissionWriter& writer) { Join(robot, lease_token, writer); },
                    [self](const absl::Status& status) { self->End(status); });
}

void RobotWatchStream::Join(const RobotId& robot, std::optional<std::int64_t> lease_token,
                            MissionWriter& writer) {
  MissionHost* host = nullptr;  // which lives as long as its writer
  {
    absl::MutexLock lock(&mutex_);
    host = host_.get();
  }
  if (host == nullptr) return;  // the caller has left meanwhile
  RobotNotices& notices = *host->robot_notices();
  // What is looked at is the mission's, whoever watches.
  const FairKey turn{.group = "", .member = host->id(), .tenant = host->tenant()};
  const absl::Status status = notices.Join(
      {shared_from_this(), this}, robot, lease_token,
      [turn, pool = context_.query_pool](std::function<void()> look) {
        return pool->Submit(turn, {std::move(look)});
      },
      *writer.conduct().Snapshot(), host->leases(), host->standing().state());
  if (!status.ok()) return End(status);
  bool left = false;
  {
    absl::MutexLock lock(&mutex_);
    left = host_ == nullptr;
  }
  if (left) return notices.Leave(this);
  Pump();
}

void RobotWatchStream::LetGo() {
  std::shared_ptr<MissionHost> host;  // not let go by the writer, which may be the last to hold us
  {
    absl::MutexLock lock(&mutex_);
    host.swap(host_);
  }
  if (host != nullptr) {
    host->end_listeners().Remove(listener_);
    host->robot_notices()->Leave(this);
  }
}

StreamPump::Operation RobotWatchStream::NextOperation() {
  if (host_ == nullptr) return nullptr;
  const std::optional<RobotNotice> notice = host_->robot_notices()->Next(this);
  if (!notice) return nullptr;
  in_flight_ = ToProto(*notice, host_->id());
  if (in_flight_.has_plan_invalidated()) {
    const v1::PlanInvalidated& told = in_flight_.plan_invalidated();
    LogInfo("plan invalidated", {{"plan", told.plan()},
                                 {"reason", v1::PlanInvalidated::Reason_Name(told.reason())},
                                 {"detail", told.detail()},
                                 {"request_id", visit_.info().request_id}});
  }
  return Write(&in_flight_);
}

}  // namespace plumescout::server
