// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/flow_cases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace flow_cases_test {

TEST(FlowCasesTest, InterpolatesCubicsExactly) {
  std::vector<LineSample> samples;
  for (const double at : {0.0, 0.1, 0.3, 0.5, 0.9, 1.0}) {
    samples.push_back({at, at * at * at - 2.0 * at});
  }
  for (const double at : {0.0, 0.05, 0.2, 0.45, 0.7, 0.97}) {
    EXPECT_NEAR(Interpolate(samples, at), at * at * at - 2.0 * at, 1e-14) << at;
  }
}

TEST(FlowCasesTest, FindsTheBottomOfAParabolaBetweenSamples) {
  std::vector<LineSample> samples = {{0.0, 0.0}};
  for (int i = 0; i < 10; ++i) {
    const double at = (i + 0.5) / 10.0;
    samples.push_back({at, (at - 0.47) * (at - 0.47) - 3.0});
  }
  samples.push_back({1.0, 0.0});
  EXPECT_NEAR(Least(samples), -3.0, 1e-14);
}

TEST(FlowCasesTest, DrivesTheStepWithOneUnitOfFlow) {
  const FlowDomain domain = StepDomain(8, 4.0);
  EXPECT_EQ(domain.fluid.width(), 48);
  EXPECT_EQ(domain.fluid.height(), 16);
  EXPECT_EQ(domain.fluid[Cell(15, 7)], 0);
  EXPECT_EQ(domain.fluid[Cell(16, 7)], 1);
  double flow = 0.0;
  double fastest = 0.0;
  for (const BoundaryFace& face : domain.openings) {
    flow += face.inflow_mps.value_or(0.0) / 8.0;
    fastest = std::max(fastest, face.inflow_mps.value_or(0.0));
  }
  EXPECT_NEAR(flow, 1.0, 1e-14);
  EXPECT_NEAR(fastest, 1.5, 0.05);  // of a parabola, less half a cell's step from its top
}

TEST(FlowCasesTest, FindsWhereAirTurnsBehindTheStep) {
  MacField velocity(StepDomain(4, 4.0).fluid.geometry());
  for (int x = 8; x <= 24; ++x) velocity.u(x, 0) = 0.1 * (x - 8) - 0.75;
  EXPECT_NEAR(ReattachmentLength(velocity), 7.5 / 4.0, 1e-14);
  EXPECT_TRUE(std::isnan(ReattachmentLength(MacField(velocity.geometry()))));
}

TEST(FlowCasesTest, FindsWhereTheChannelIsDeveloped) {
  MacField velocity(ChannelDomain(4, 4.0).fluid.geometry());
  for (int x = 0; x <= 16; ++x) velocity.u(x, 2) = std::min(1.0, 0.9 + 0.02 * x);
  EXPECT_NEAR(EntranceLength(velocity), 4.5 / 4.0, 1e-12);
}

TEST(FlowCasesTest, RunsUntilNothingChanges) {
  const auto flow = RunToSteady(CavityDomain(8), 0.1);
  ASSERT_TRUE(flow.ok()) << flow.status();
  EXPECT_LE(flow->change_per_time, SteadyLimits{}.change_per_time);
  EXPECT_LT(Least(CavityU(flow->velocity)), -0.1);
  const auto hurried = RunToSteady(CavityDomain(8), 0.1, {0.0, 2.0});
  ASSERT_TRUE(hurried.ok());
  EXPECT_GT(hurried->change_per_time, 0.0);
}

TEST(FlowCasesTest, PassesOnTheSolversErrors) {
  FlowDomain domain = CavityDomain(4);
  domain.openings = {{{0, 0}, Side::kWest, 1.0}};
  EXPECT_EQ(RunToSteady(domain, 0.1).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace flow_cases_test
}  // namespace plumescout::lab
