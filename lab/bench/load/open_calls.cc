// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/open_calls.h"

#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "lab/bench/load/own_channel.h"
#include "plumescout/v1/map_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "proto/convert/names.h"

namespace plumescout::lab {
namespace {

constexpr std::int64_t kNeverSent = std::int64_t{1} << 40;

template <typename Request, typename Response>
struct Exchange {
  Request request;
  Response response;
};

}  // namespace

struct OpenCalls::State {
  explicit State(const std::string& target) : channel(OwnChannel(target)) {}

  // `start` begins a call of a stub's callback interface.
  template <typename Request, typename Response, typename Start>
  void Begin(const Request& request, const Start& start) {
    const auto exchange = std::make_shared<Exchange<Request, Response>>();
    exchange->request = request;
    grpc::ClientContext* context = nullptr;
    {
      absl::MutexLock lock(&mutex);
      contexts.push_back(std::make_unique<grpc::ClientContext>());
      context = contexts.back().get();
      kept.push_back(exchange);
    }
    start(context, &exchange->request, &exchange->response, [this](const grpc::Status&) {
      absl::MutexLock lock(&mutex);
      ++ended;
    });
  }

  const std::shared_ptr<grpc::Channel> channel;
  mutable absl::Mutex mutex;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts ABSL_GUARDED_BY(mutex);
  std::vector<std::shared_ptr<void>> kept ABSL_GUARDED_BY(mutex);
  int ended ABSL_GUARDED_BY(mutex) = 0;
};

OpenCalls::OpenCalls(const std::string& target) : state_(std::make_unique<State>(target)) {}

OpenCalls::~OpenCalls() {
  Cancel();
  AwaitEnd(absl::InfiniteDuration());
}

std::unique_ptr<OpenCalls> OpenCalls::WaitForLog(const std::string& target,
                                                 const client::RobotSession& session, int count) {
  std::unique_ptr<OpenCalls> calls(new OpenCalls(target));
  v1::PlanningService::Stub stub(calls->state_->channel);
  v1::CheckTrajectoryRequest request;
  request.set_robot(RobotResource({session.mission, session.robot}));
  request.set_lease_token(session.lease_token);
  request.mutable_path()->add_vertices();
  request.mutable_path()->set_goal_kind(v1::GOAL_KIND_HOME);
  request.set_min_applied_sequence(kNeverSent);
  for (int i = 0; i < count; ++i) {
    calls->state_->Begin<v1::CheckTrajectoryRequest, v1::CheckTrajectoryResponse>(
        request, [&stub](auto... arguments) { stub.async()->CheckTrajectory(arguments...); });
  }
  return calls;
}

std::unique_ptr<OpenCalls> OpenCalls::Plan(const std::string& target,
                                           const client::RobotSession& session, int count,
                                           absl::Duration budget) {
  std::unique_ptr<OpenCalls> calls(new OpenCalls(target));
  v1::PlanningService::Stub stub(calls->state_->channel);
  v1::NextBestTrajectoryRequest request;
  request.set_robot(RobotResource({session.mission, session.robot}));
  request.set_lease_token(session.lease_token);
  request.mutable_planning_budget()->set_seconds(absl::ToInt64Seconds(budget));
  for (int i = 0; i < count; ++i) {
    calls->state_->Begin<v1::NextBestTrajectoryRequest, v1::NextBestTrajectoryResponse>(
        request, [&stub](auto... arguments) { stub.async()->NextBestTrajectory(arguments...); });
  }
  return calls;
}

std::unique_ptr<OpenCalls> OpenCalls::ReadFreshMap(const std::string& target,
                                                   const MissionId& mission, int count) {
  std::unique_ptr<OpenCalls> calls(new OpenCalls(target));
  v1::MapService::Stub stub(calls->state_->channel);
  v1::GetMapRequest request;
  request.set_mission(MissionResource(mission));
  request.set_fresh_posterior(true);
  for (int i = 0; i < count; ++i) {
    calls->state_->Begin<v1::GetMapRequest, v1::GetMapResponse>(
        request, [&stub](auto... arguments) { stub.async()->GetMap(arguments...); });
  }
  return calls;
}

void OpenCalls::Cancel() {
  std::vector<grpc::ClientContext*> contexts;
  {
    absl::MutexLock lock(&state_->mutex);
    for (const auto& context : state_->contexts) contexts.push_back(context.get());
  }
  // A call may end on this very thread, which then takes the lock.
  for (grpc::ClientContext* context : contexts) context->TryCancel();
}

int OpenCalls::ended() const {
  absl::MutexLock lock(&state_->mutex);
  return state_->ended;
}

bool OpenCalls::AwaitEnd(absl::Duration timeout) const {
  State& state = *state_;
  absl::MutexLock lock(&state.mutex);
  const auto all_ended = [&state]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(state.mutex) {
    return state.ended == static_cast<int>(state.contexts.size());
  };
  return state.mutex.AwaitWithTimeout(absl::Condition(&all_ended), timeout);
}

}  // namespace plumescout::lab
