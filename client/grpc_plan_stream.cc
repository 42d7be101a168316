// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_plan_stream.h"

#include <optional>
#include <utility>

#include "absl/time/clock.h"
#include "client/grpc_reader.h"
#include "client/grpc_status.h"
#include "core/types/status_macros.h"
#include "proto/convert/plan.h"

namespace plumescout::client {
namespace {

class GrpcPlanStream final : public PlanStream {
 public:
  GrpcPlanStream(MissionRoutes& routes, v1::PlanningService::Stub& stub,
                 const v1::StreamNextBestTrajectoryRequest& request, absl::Duration timeout)
      : reader_(routes, stub, &v1::PlanningService::Stub::PrepareAsyncStreamNextBestTrajectory,
                request, absl::Now() + timeout) {}

  absl::StatusOr<std::optional<Plan>> Read(absl::Duration timeout) override {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<v1::StreamNextBestTrajectoryResponse> message,
                                reader_.Read(timeout));
    if (!message) return std::nullopt;
    PLUMESCOUT_ASSIGN_OR_RETURN(Plan plan, FromServer(FromProto(message->plan(), "plan")));
    return plan;
  }
  void Cancel() override { reader_.Cancel(); }

 private:
  GrpcReader<v1::StreamNextBestTrajectoryResponse> reader_;
};

}  // namespace

std::unique_ptr<PlanStream> OpenGrpcPlanStream(MissionRoutes& routes,
                                               v1::PlanningService::Stub& stub,
                                               const v1::StreamNextBestTrajectoryRequest& request,
                                               absl::Duration timeout) {
  return std::make_unique<GrpcPlanStream>(routes, stub, request, timeout);
}

}  // namespace plumescout::client
