// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Robots that stop at sites and sample, by a planning service over gRPC.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "core/plan/strategy.h"
#include "tests/e2e/hall_run.h"

namespace plumescout::lab {
namespace sampling_test {

using ::testing::SizeIs;

// 3 x 5 sites in the open west of the hall; the robot starts in the first of the squares.
constexpr Rectangle kRegion = {{0.6, 0.6}, {2.1, 3.1}};
constexpr double kSpacing_m = 0.5;

// Readings are taken at stops alone.
EpisodeOptions SamplingOptions(const char* strategy) {
  EpisodeOptions options = HallOptions();
  options.duration_s = 150.0;
  options.gas_settling_s = 1.0;
  PlanningOptions& planning = options.create->planning;
  planning.strategy = strategy;
  EXPECT_TRUE(ApplyStrategyRow(planning).ok());
  planning.dwell_s = 2.0;
  planning.sites.spacing_m = kSpacing_m;
  return options;
}

HallRun RunOverGrpc(const EpisodeOptions& options) {
  const auto server = StartServer();
  const auto planner = ClientOf(*server);
  absl::StatusOr<HallRun> run = RunInHall(*planner, options);
  EXPECT_TRUE(run.ok()) << run.status();
  return run.ok() ? *std::move(run) : HallRun{};
}

// Column and row in the region.
std::pair<int, int> SquareOf(Point2 place) {
  return {static_cast<int>(std::floor((place.x_m - kRegion.min.x_m) / kSpacing_m)),
          static_cast<int>(std::floor((place.y_m - kRegion.min.y_m) / kSpacing_m))};
}

const Candidate& Chosen(const Plan& plan) {
  return plan.candidates.at(static_cast<std::size_t>(plan.chosen));
}

TEST(SamplingTest, LhrSurveysThenSamplesEachSiteOnceAndIsComplete) {
  EpisodeOptions options = SamplingOptions("lhr");
  options.create->planning.sites.region = kRegion;
  options.create->planning.sites.survey_stride = 2;
  const HallRun run = RunOverGrpc(options);
  EXPECT_TRUE(run.episode.completed);
  EXPECT_EQ(run.episode.collisions, 0);
  std::set<std::pair<int, int>> sampled;
  std::vector<MissionPhase> phases;
  for (const IssuedPlan& issued : run.episode.plans) {
    const Plan& plan = issued.plan;
    if (phases.empty() || phases.back() != plan.phase) phases.push_back(plan.phase);
    if (plan.chosen < 0) continue;
    EXPECT_LE(plan.trajectory.duration_s, options.create->planning.sites.update_period_s + 1e-9);
    for (const Point2 stop : Chosen(plan).stops) {
      EXPECT_TRUE(sampled.insert(SquareOf(stop)).second) << stop.x_m << ", " << stop.y_m;
    }
  }
  EXPECT_THAT(sampled, SizeIs(15));
  EXPECT_THAT(phases, ::testing::ElementsAre(MissionPhase::kSurvey, MissionPhase::kSampling,
                                             MissionPhase::kComplete));
  EXPECT_THAT(Chosen(run.episode.plans.front().plan).stops, SizeIs(6));
}

TEST(SamplingTest, TheRewardOfConcentrationAndDoubtSendsARobotFromSiteToSite) {
  EpisodeOptions options = SamplingOptions("ipp_reward");
  options.duration_s = 60.0;
  const HallRun run = RunOverGrpc(options);
  EXPECT_FALSE(run.episode.completed);
  EXPECT_EQ(run.episode.collisions, 0);
  ASSERT_GE(run.episode.plans.size(), 10u) << "sites half a metre apart, 2 s at each";
  std::set<std::pair<int, int>> visited;
  for (const IssuedPlan& issued : run.episode.plans) {
    EXPECT_EQ(issued.plan.phase, MissionPhase::kSampling);
    ASSERT_GE(issued.plan.chosen, 0) << issued.plan.explanation;
    EXPECT_TRUE(Chosen(issued.plan).reward.has_value());
    EXPECT_THAT(Chosen(issued.plan).stops, SizeIs(1));
    visited.insert(SquareOf(Chosen(issued.plan).goal.position));
  }
  EXPECT_GT(visited.size(), 5u);
}

}  // namespace sampling_test
}  // namespace plumescout::lab
