// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/plan_stream.h"

#include <grpcpp/server_context.h>

#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/names.h"
#include "proto/convert/plan.h"
#include "server/base/grpc_status.h"
#include "server/calls/patient_attempt.h"
#include "server/streams/plan_order_from_proto.h"

namespace plumescout::server {

PlanStream* PlanStream::Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                              const v1::StreamNextBestTrajectoryRequest& request) {
  auto stream = std::make_shared<PlanStream>(context);
  stream->self_ = stream;
  context->streams->Add(stream);
  const absl::Status entered =
      stream->visit_.Enter(*context->door, Rpc::kStreamNextBestTrajectory, *call);
  context->streams->LetIn(stream.get(), stream->visit_.info().recheck);
  if (!entered.ok()) {
    stream->Ordered(entered);
    return stream.get();
  }
  AttemptPatiently(
      *context, stream->visit_.info().deadline,
      [stream, &request] { return stream->Order(request); },
      [stream](const absl::Status& status) { stream->Ordered(status); });
  return stream.get();
}

void PlanStream::Ordered(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    ordering_ = false;
  }
  if (!status.ok()) return End(status);
  Pump();
}

absl::Status PlanStream::Order(const v1::StreamNextBestTrajectoryRequest& request) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robot", request.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(PlanOrder order, PlanOrderFromProto(request, context_.limits));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto host, context_.FindMissionOf(visit_.caller(), name));
  PLUMESCOUT_RETURN_IF_ERROR(host->CheckMayPlan());
  PLUMESCOUT_RETURN_IF_ERROR(host->leases().Use(name.robot, order.lease_token));
  PLUMESCOUT_RETURN_IF_ERROR(host->rates().AdmitPlan(name.robot));
  order.request.robot = name.robot;
  order.deadline = After(visit_.info().deadline, -context_.limits.deadline_margin);
  mission_ = name.mission;
  const auto self = shared_from_this();
  const auto job = std::make_shared<PlanJob>(
      PlanJob::Parts{host, context_.planning_pool, std::move(order),
                     [self](const absl::StatusOr<PlanAnswer>& answer) { self->Conclude(answer); },
                     [self](const Plan& plan) { self->Offer(plan); }, visit_.info().stage_times});
  {
    absl::MutexLock lock(&mutex_);
    if (end_.has_value()) return *end_;  // the server went down in the meantime
    job_ = job;
  }
  job->Start();
  return absl::OkStatus();
}

void PlanStream::Offer(const Plan& plan) {
  v1::StreamNextBestTrajectoryResponse response;
  *response.mutable_plan() = ToProto(plan, mission_);
  {
    absl::MutexLock lock(&mutex_);
    if (end_.has_value()) return;
    waiting_ = std::move(response);
  }
  Pump();
}

void PlanStream::Conclude(const absl::StatusOr<PlanAnswer>& answer) {
  if (!answer.ok()) return End(WithField(answer.status(), ""));
  LogPlan(mission_, *answer, visit_.info().request_id);
  v1::StreamNextBestTrajectoryResponse response;
  *response.mutable_plan() = ToProto(answer->plan, mission_);
  {
    absl::MutexLock lock(&mutex_);
    if (end_.has_value()) return;
    waiting_ = std::move(response);
    end_ = absl::OkStatus();
  }
  Pump();
}

void PlanStream::End(const absl::Status& status) {
  std::shared_ptr<PlanJob> job;
  {
    absl::MutexLock lock(&mutex_);
    if (!end_.has_value()) {
      end_ = status;
      waiting_.reset();
      job = job_;
    }
  }
  if (job != nullptr) job->Cancel();
  Pump();
}

void PlanStream::OnWriteDone(bool ok) {
  {
    absl::MutexLock lock(&mutex_);
    writing_ = false;
  }
  if (!ok) return End(absl::CancelledError("the stream broke"));
  Pump();
}

void PlanStream::OnDone() {
  context_.streams->Remove(this);
  const auto self = std::move(self_);
  std::shared_ptr<PlanJob> job;
  {
    absl::MutexLock lock(&mutex_);
    job = std::move(job_);
  }
}

void PlanStream::Pump() {
  const auto self = shared_from_this();  // the finish may end us
  pump_.Run(mutex_, [this] {
    mutex_.AssertHeld();
    return NextOperation();
  });
}

StreamPump::Operation PlanStream::NextOperation() {
  if (finished_ || ordering_ || writing_) return nullptr;
  if (waiting_.has_value()) {
    in_flight_ = *std::exchange(waiting_, std::nullopt);
    if (end_.has_value()) {
      finished_ = true;
      return
          [this] { StartWriteAndFinish(&in_flight_, {}, ToGrpc(visit_.Leave(absl::OkStatus()))); };
    }
    writing_ = true;
    return [this] { StartWrite(&in_flight_); };
  }
  if (!end_.has_value()) return nullptr;
  finished_ = true;
  return [this, status = *end_] { Finish(ToGrpc(visit_.Leave(status), visit_.info().request_id)); };
}

}  // namespace plumescout::server
