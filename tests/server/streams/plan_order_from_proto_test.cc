// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/plan_order_from_proto.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "proto/convert/status.h"

namespace plumescout::server {
namespace plan_order_from_proto_test {

std::string RefusedField(const v1::NextBestTrajectoryRequest& request) {
  const auto violations = FieldViolations(PlanOrderFromProto(request, {}).status());
  return violations.empty() ? "" : violations[0].field;
}

TEST(PlanOrderFromProtoTest, EveryFieldIsTaken) {
  v1::NextBestTrajectoryRequest request;
  request.set_lease_token(5);
  request.mutable_start()->set_x_m(1.5);
  request.set_min_applied_sequence(9);
  request.mutable_planning_budget()->set_nanos(300'000'000);
  request.set_seed(-1);
  request.set_go_home(true);
  request.set_max_edge_evaluation_count(1000);
  const PlanOrder order = PlanOrderFromProto(request, {}).value();
  EXPECT_EQ(order.lease_token, 5);
  EXPECT_EQ(order.request.start, (Pose2{1.5, 0.0, 0.0}));
  EXPECT_EQ(order.min_applied_sequence, 9);
  EXPECT_EQ(order.budget, absl::Milliseconds(300));
  EXPECT_EQ(order.request.seed, std::numeric_limits<std::uint64_t>::max());
  EXPECT_TRUE(order.request.go_home);
  EXPECT_EQ(order.request.max_edge_evaluations, 1000);
}

TEST(PlanOrderFromProtoTest, StreamsAreOrderedAlike) {
  v1::StreamNextBestTrajectoryRequest request;
  request.mutable_start()->set_x_m(2.5);
  request.set_min_applied_sequence(12);
  request.mutable_planning_budget()->set_nanos(5'000'000);
  request.set_go_home(true);
  const auto order = PlanOrderFromProto(request, ServiceLimits{});
  ASSERT_TRUE(order.ok()) << order.status();
  EXPECT_EQ(order->request.start.value().x_m, 2.5);
  EXPECT_EQ(order->min_applied_sequence, 12);
  EXPECT_EQ(order->budget, absl::Milliseconds(5));
  EXPECT_TRUE(order->request.go_home);
}

TEST(PlanOrderFromProtoTest, BudgetDefaultsAndIsCut) {
  const ServiceLimits limits{.default_planning_budget = absl::Milliseconds(700),
                             .max_planning_budget = absl::Seconds(2)};
  v1::NextBestTrajectoryRequest request;
  EXPECT_EQ(PlanOrderFromProto(request, limits)->budget, absl::Milliseconds(700));
  request.mutable_planning_budget();
  EXPECT_EQ(PlanOrderFromProto(request, limits)->budget, absl::Milliseconds(700));
  request.mutable_planning_budget()->set_seconds(3600);
  EXPECT_EQ(PlanOrderFromProto(request, limits)->budget, absl::Seconds(2));
  EXPECT_FALSE(
      PlanOrderFromProto(v1::NextBestTrajectoryRequest(), limits)->request.start.has_value());
}

TEST(PlanOrderFromProtoTest, BadFieldsAreNamed) {
  v1::NextBestTrajectoryRequest request;
  request.mutable_planning_budget()->set_seconds(-1);
  EXPECT_EQ(RefusedField(request), "planning_budget.seconds");
  request.mutable_planning_budget()->set_seconds(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(RefusedField(request), "planning_budget.seconds");
  request.mutable_planning_budget()->set_seconds(0);
  request.mutable_planning_budget()->set_nanos(-1);
  EXPECT_EQ(RefusedField(request), "planning_budget.nanos");
}

TEST(TeamOrderFromProtoTest, EveryFieldIsTaken) {
  v1::PlanTeamRequest request;
  request.add_robots("missions/hall/robots/b");
  request.add_robots("missions/hall/robots/a");
  request.mutable_planning_budget()->set_nanos(300'000'000);
  request.set_seed(5);
  request.set_max_order_count(7);
  request.set_go_home(true);
  request.set_max_edge_evaluation_count(1000);
  const TeamOrder order = TeamOrderFromProto(request, "hall", {}).value();
  EXPECT_EQ(order.request.robots, (std::vector<RobotId>{"b", "a"}));
  EXPECT_EQ(order.budget, absl::Milliseconds(300));
  EXPECT_EQ(order.request.seed, 5U);
  EXPECT_EQ(order.request.max_order_count, 7);
  EXPECT_TRUE(order.request.go_home);
  EXPECT_EQ(order.request.max_edge_evaluations, 1000);
  EXPECT_EQ(TeamOrderFromProto({}, "hall", {})->request.max_order_count, 3);
  EXPECT_FALSE(TeamOrderFromProto(request, "attic", {}).ok());
}

}  // namespace plan_order_from_proto_test
}  // namespace plumescout::server
