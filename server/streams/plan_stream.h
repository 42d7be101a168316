// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/server_callback.h>

#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "plumescout/v1/planning_service.pb.h"
#include "server/calls/active_streams.h"
#include "server/calls/service_context.h"
#include "server/missions/plan_job.h"
#include "server/streams/stream_pump.h"

namespace plumescout::server {

// One stream of better and better plans, the last of which is committed. A plan that waits behind a
// slow write gives way to a newer one: a slow reader costs one message, never a queue.
class PlanStream final : public grpc::ServerWriteReactor<v1::StreamNextBestTrajectoryResponse>,
                         public EndableStream,
                         public std::enable_shared_from_this<PlanStream> {
 public:
  // The reactor owns itself until gRPC is done with it.
  static PlanStream* Start(const ServiceContext* context, grpc::CallbackServerContext* call,
                           const v1::StreamNextBestTrajectoryRequest& request);

  explicit PlanStream(const ServiceContext* context) : context_(*context) {}

  // Nothing is committed after it.
  void End(const absl::Status& status) override;

  void OnWriteDone(bool ok) override;
  void OnCancel() override { End(absl::CancelledError("the caller gave up")); }
  void OnDone() override;

 private:
  absl::Status Order(const v1::StreamNextBestTrajectoryRequest& request);
  void Ordered(const absl::Status& status);
  void Offer(const Plan& plan);
  void Conclude(const absl::StatusOr<PlanAnswer>& answer);
  // Starts whatever can start now: a write, or the finish.
  void Pump() ABSL_LOCKS_EXCLUDED(mutex_);
  StreamPump::Operation NextOperation() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const ServiceContext& context_;
  std::shared_ptr<PlanStream> self_;  // until OnDone
  Visit visit_;
  MissionId mission_;

  absl::Mutex mutex_;
  StreamPump pump_;
  std::shared_ptr<PlanJob> job_ ABSL_GUARDED_BY(mutex_);  // until OnDone; holds this stream in turn
  std::optional<v1::StreamNextBestTrajectoryResponse> waiting_ ABSL_GUARDED_BY(mutex_);
  v1::StreamNextBestTrajectoryResponse in_flight_;  // while writing_
  bool ordering_ ABSL_GUARDED_BY(mutex_) = true;    // the request is there meanwhile
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
  // OK: what waits is the last plan.
  std::optional<absl::Status> end_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
