// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/plan_order_from_proto.h"

#include <algorithm>
#include <limits>

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/observation.h"

namespace plumescout::server {
namespace {

constexpr std::int64_t kMaxNanos = 999'999'999;
// google.protobuf.Duration's own range: 10000 years.
constexpr std::int64_t kMaxSeconds = 315'576'000'000;

template <typename Request>
absl::StatusOr<absl::Duration> ReadBudget(const Request& request, const ServiceLimits& limits) {
  if (!request.has_planning_budget()) return limits.default_planning_budget;
  const auto& budget = request.planning_budget();
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange("planning_budget.seconds", budget.seconds(), 0, kMaxSeconds));
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange("planning_budget.nanos", budget.nanos(), 0, kMaxNanos));
  const absl::Duration wanted = absl::Seconds(budget.seconds()) + absl::Nanoseconds(budget.nanos());
  if (wanted == absl::ZeroDuration()) return limits.default_planning_budget;
  return std::min(wanted, limits.max_planning_budget);
}

template <typename Request>
absl::StatusOr<PlanOrder> ReadOrder(const Request& request, const ServiceLimits& limits) {
  PlanOrder order;
  order.lease_token = request.lease_token();
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange("min_applied_sequence", request.min_applied_sequence(), 0, kMaxSequence));
  order.min_applied_sequence = request.min_applied_sequence();
  PLUMESCOUT_ASSIGN_OR_RETURN(order.budget, ReadBudget(request, limits));
  if (request.has_start()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(order.request.start, FromProto(request.start(), "start"));
  }
  order.request.go_home = request.go_home();
  order.request.seed = static_cast<std::uint64_t>(request.seed());
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange("max_edge_evaluation_count",
                                           request.max_edge_evaluation_count(), 0,
                                           std::numeric_limits<std::int64_t>::max()));
  order.request.max_edge_evaluations = request.max_edge_evaluation_count();
  return order;
}

}  // namespace

absl::StatusOr<PlanOrder> PlanOrderFromProto(const v1::NextBestTrajectoryRequest& request,
                                             const ServiceLimits& limits) {
  return ReadOrder(request, limits);
}
absl::StatusOr<PlanOrder> PlanOrderFromProto(const v1::StreamNextBestTrajectoryRequest& request,
                                             const ServiceLimits& limits) {
  return ReadOrder(request, limits);
}

absl::StatusOr<TeamOrder> TeamOrderFromProto(const v1::PlanTeamRequest& request,
                                             const MissionId& mission,
                                             const ServiceLimits& limits) {
  TeamOrder order;
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange("robots.size", request.robots_size(), 0, kMostTeamRobots));
  for (const std::string& robot : request.robots()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const RobotName name, ParseRobotName("robots", robot));
    if (name.mission != mission) return FieldError("robots", robot, "must be of the mission");
    const auto& before = order.request.robots;
    if (std::find(before.begin(), before.end(), name.robot) != before.end()) {
      return FieldError("robots", robot, "must be named once");
    }
    order.request.robots.push_back(name.robot);
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(order.budget, ReadBudget(request, limits));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange("max_order_count", request.max_order_count(), 0, kMostTeamOrders));
  constexpr int kUsualOrders = 3;
  order.request.max_order_count =
      request.max_order_count() == 0 ? kUsualOrders : request.max_order_count();
  order.request.go_home = request.go_home();
  order.request.seed = static_cast<std::uint64_t>(request.seed());
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange("max_edge_evaluation_count",
                                           request.max_edge_evaluation_count(), 0,
                                           std::numeric_limits<std::int64_t>::max()));
  order.request.max_edge_evaluations = request.max_edge_evaluation_count();
  return order;
}

}  // namespace plumescout::server
