// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/flood.h"

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <utility>

#include "absl/synchronization/mutex.h"
#include "absl/time/clock.h"
#include "core/types/rng.h"
#include "lab/bench/load/own_channel.h"
#include "plumescout/v1/ingest_service.grpc.pb.h"
#include "plumescout/v1/planning_service.grpc.pb.h"
#include "plumescout/v1/system_service.grpc.pb.h"
#include "proto/convert/names.h"
#include "proto/convert/observation.h"

namespace plumescout::lab {
namespace {

constexpr double kUsualPlansPerSecond = 1.0;
constexpr double kUsualReadingsPerSecond = 10.0;
constexpr int kBatch = 256;
constexpr int kMaxUnanswered = 1000;
constexpr std::chrono::seconds kCallPatience(10);

// A plan that is asked for.
struct Order {
  grpc::ClientContext context;
  v1::NextBestTrajectoryRequest request;
  v1::NextBestTrajectoryResponse response;
};

}  // namespace

Quota AskQuota(const std::string& target) {
  v1::SystemService::Stub stub(OwnChannel(target));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kCallPatience);
  v1::GetServerInfoResponse response;
  stub.GetServerInfo(&context, v1::GetServerInfoRequest(), &response);  // none: no limits
  const v1::ServerLimits& limits = response.limits();
  return {limits.max_plans_per_s() > 0.0 ? limits.max_plans_per_s() : kUsualPlansPerSecond,
          limits.max_gas_readings_per_s() > 0.0 ? limits.max_gas_readings_per_s()
                                                : kUsualReadingsPerSecond};
}

Flood::Flood(const std::string& target, const client::RobotSession& session,
             const FloodOptions& options)
    : target_(target),
      session_(session),
      options_(options),
      planner_([this] { AskForPlans(); }),
      sensors_([this] { SendReadings(); }) {}

Flood::~Flood() {
  stopping_ = true;
  planner_.join();
  sensors_.join();
}

FloodFigures Flood::figures() const {
  return {plans_asked_, plans_made_, readings_sent_, readings_taken_};
}

void Flood::AskForPlans() {
  if (options_.plans_per_s <= 0.0) return;
  v1::PlanningService::Stub stub(OwnChannel(target_));
  absl::Mutex mutex;
  int unanswered = 0;  // guarded by `mutex`
  const absl::Time began = absl::Now();
  for (std::int64_t i = 0; !stopping_; ++i) {
    absl::SleepFor(began + absl::Seconds(static_cast<double>(i) / options_.plans_per_s) -
                   absl::Now());
    {
      absl::MutexLock lock(&mutex);
      if (unanswered >= kMaxUnanswered) continue;
      ++unanswered;
    }
    auto order = std::make_shared<Order>();
    order->context.set_deadline(std::chrono::system_clock::now() + kCallPatience);
    order->request.set_robot(RobotResource({session_.mission, session_.robot}));
    order->request.set_lease_token(session_.lease_token);
    ++plans_asked_;
    stub.async()->NextBestTrajectory(
        &order->context, &order->request, &order->response,
        [this, order, &mutex, &unanswered](grpc::Status status) mutable {
          if (status.ok()) ++plans_made_;
          order = nullptr;  // it holds the channel that ends with us
          absl::MutexLock lock(&mutex);
          --unanswered;
        });
  }
  absl::MutexLock lock(&mutex);
  mutex.Await(absl::Condition(
      +[](int* count) { return *count == 0; }, &unanswered));
}

void Flood::SendReadings() {
  if (options_.readings_per_s <= 0.0) return;
  v1::IngestService::Stub stub(OwnChannel(target_));
  Rng rng(options_.seed);
  v1::BatchIngestObservationsRequest request;
  request.mutable_open()->set_robot(RobotResource({session_.mission, session_.robot}));
  request.mutable_open()->set_lease_token(session_.lease_token);
  std::int64_t applied = session_.ingest.applied_sequence;
  const absl::Time began = absl::Now();
  for (std::int64_t i = 0; !stopping_; ++i) {
    absl::SleepFor(began +
                   absl::Seconds(static_cast<double>(i * kBatch) / options_.readings_per_s) -
                   absl::Now());
    request.clear_batch();
    for (int k = 1; k <= kBatch; ++k) {
      const Pose2 pose{rng.Uniform(-options_.spread_m, options_.spread_m),
                       rng.Uniform(-options_.spread_m, options_.spread_m), 0.0};
      *request.mutable_batch()->add_observations() = ToProto(
          Observation{applied + k, absl::ToUnixNanos(absl::Now()), pose, GasReading{1.0, 0.0}});
    }
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kCallPatience);
    v1::BatchIngestObservationsResponse response;
    readings_sent_ += kBatch;
    if (!stub.BatchIngestObservations(&context, request, &response).ok()) continue;
    readings_taken_ += response.ingest_state().applied_sequence() - applied;
    applied = response.ingest_state().applied_sequence();
  }
}

}  // namespace plumescout::lab
