// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling_strategy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tests/support/site_case.h"
#include "tests/support/strategy_case.h"

namespace plumescout {
namespace sampling_strategy_test {

using testing::Chosen;
using testing::For;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::OpenArt;
using testing::SiteBelief;
using testing::SiteOptionsOf;
using ::testing::SizeIs;
using testing::TryPlan;

constexpr double kRounding = 1e-9;

// A room with a wall in it, a walled-in cell, and cells too near a wall to drive.
const testing::GridArt kRoom = {"............",  //
                                "....#.......",  //
                                "....#....###",  //
                                "....#....#.#",  //
                                "..iii....###",  //
                                "S...........",  //
                                "............"};

Plan PlanOf(const Belief& belief, const PlanningOptions& options, std::uint64_t seed = 0) {
  const auto plan = TryPlan(belief, For("r", seed), options);
  EXPECT_TRUE(plan.ok()) << plan.status();
  return plan.ok() ? *plan : Plan{};
}

// What becomes of a mission whose robot does as it is told: every stop is sampled.
struct History {
  std::map<std::size_t, int> samples;  // by the index of the cell
  std::vector<Plan> plans;
};

History Simulate(Belief belief, const PlanningOptions& options, int max_plans = 1000) {
  History run;
  for (int i = 0; i < max_plans; ++i) {
    run.plans.push_back(PlanOf(belief, options));
    const Plan& plan = run.plans.back();
    if (plan.chosen < 0) break;
    const std::vector<Cell> cells = testing::CellsOf(belief.geometry(), Chosen(plan).stops);
    for (const Cell cell : cells) ++run.samples[belief.geometry().Index(cell)];
    testing::SetSampled(belief, cells);
    testing::MovePose(belief, Chosen(plan).stops.back());
    ++belief.robots["r"].plans_issued;
    ++belief.revision;
  }
  return run;
}

TEST(SamplingStrategy, SamplesEachReachableSiteOnceAndIsComplete) {
  const Belief belief = SiteBelief(kRoom);
  for (const char* name : {"lhr", "random_sampling", "sweep"}) {
    const History run = Simulate(belief, SiteOptionsOf(name, belief.geometry()));
    EXPECT_THAT(run.samples, SizeIs(12 * 7 - 3 - 8 - 1 - 3)) << name;
    for (const auto& [cell, samples] : run.samples) EXPECT_EQ(samples, 1) << name << " " << cell;
    EXPECT_EQ(run.plans.back().phase, MissionPhase::kComplete) << name;
    EXPECT_EQ(run.plans.back().end, PlanEnd::kMissionComplete) << name;
    EXPECT_THAT(run.plans.back().trajectory.waypoints, IsEmpty());
    EXPECT_THAT(run.plans.back().explanation, HasSubstr("no site is left")) << name;
  }
}

TEST(SamplingStrategy, WithoutRevisitsTheRewardOfConcentrationEndsToo) {
  const Belief belief = SiteBelief(kRoom);
  PlanningOptions options = SiteOptionsOf("ipp_reward", belief.geometry());
  options.sites.reward = SamplingReward::kConcentrationPerTime;
  const History run = Simulate(belief, options);
  EXPECT_THAT(run.samples, SizeIs(69));
  EXPECT_EQ(run.plans.back().phase, MissionPhase::kComplete);
}

TEST(SamplingStrategy, OtherRewardsNeverEnd) {
  const Belief belief = SiteBelief(OpenArt(2, 1));
  const History run = Simulate(belief, SiteOptionsOf("ipp_reward", belief.geometry()), 10);
  EXPECT_THAT(run.plans, SizeIs(10));
  EXPECT_EQ(run.plans.back().phase, MissionPhase::kSampling);
}

TEST(SamplingStrategy, SurveysThenSamples) {
  const Belief belief = SiteBelief(OpenArt(9, 9));
  PlanningOptions options = SiteOptionsOf("lhr", belief.geometry());
  options.sites.survey = true;
  options.sites.survey_stride = 4;
  const History run = Simulate(belief, options);
  EXPECT_THAT(run.samples, SizeIs(81));
  EXPECT_EQ(run.plans.front().phase, MissionPhase::kSurvey);
  EXPECT_THAT(Chosen(run.plans.front()).stops, SizeIs(9));
  for (std::size_t i = 1; i + 1 < run.plans.size(); ++i) {
    EXPECT_EQ(run.plans[i].phase, MissionPhase::kSampling);
  }
  EXPECT_EQ(run.plans.back().phase, MissionPhase::kComplete);
}

// [LHR] section IV-A: 142 s for the survey, 70 s of them driving at 5 m/s.
TEST(SamplingStrategy, SurveysThePapersRegionIn142Seconds) {
  Belief belief;
  GridGeometry map{-0.5, -0.5, 1.0, 51, 51};
  belief.revision = 1;
  belief.options = std::make_shared<const MissionOptions>();
  belief.occupancy = std::make_shared<const Grid<CellState>>(map, CellState::kFree);
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(map, 1);
  belief.sampled = std::make_shared<const Grid<std::uint8_t>>(map, 0);
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(map, 0.0F);
  belief.gas_variance_ppm2 = belief.gas_mean_ppm;
  testing::MovePose(belief, {0.0, 0.0});
  PlanningOptions options = SiteOptionsOf("lhr", map);
  options.sites.spacing_m = 1.0;
  options.sites.survey = true;
  options.speed_mps = 5.0;
  const Plan plan = PlanOf(belief, options);
  EXPECT_EQ(plan.phase, MissionPhase::kSurvey);
  EXPECT_THAT(Chosen(plan).stops, SizeIs(36));
  EXPECT_NEAR(Chosen(plan).length_m, 350.0, kRounding);
  EXPECT_NEAR(plan.trajectory.length_m, 350.0, kRounding);
  EXPECT_NEAR(plan.trajectory.duration_s, 142.0, kRounding);
}

TEST(SamplingStrategy, KeepsToTheUpdatePeriod) {
  const Belief belief = SiteBelief(kRoom);
  PlanningOptions options = SiteOptionsOf("lhr", belief.geometry());
  options.sites.update_period_s = 21.3;
  const History run = Simulate(belief, options);
  EXPECT_GT(run.plans.size(), 69u / 10u) << "more than with time for ten each";
  for (const Plan& plan : run.plans) {
    EXPECT_LE(plan.trajectory.duration_s, options.sites.update_period_s + kRounding);
  }
}

TEST(SamplingStrategy, StopsAtItsSitesAloneAndStaysClear) {
  const Belief belief = SiteBelief(kRoom);
  for (const char* name : {"lhr", "random_sampling", "sweep", "ipp_reward"}) {
    Grid<float> price(belief.geometry(), std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < price.size(); ++i) {
      if ((*belief.traversable)[i] != 0) price[i] = 1.0F;
    }
    for (const Plan& plan : Simulate(belief, SiteOptionsOf(name, belief.geometry()), 30).plans) {
      if (plan.chosen < 0) continue;
      std::vector<Point2> dwelled;
      for (const Waypoint& waypoint : plan.trajectory.waypoints) {
        if (waypoint.dwell_s > 0.0) dwelled.push_back(waypoint.pose.position());
      }
      EXPECT_EQ(dwelled, Chosen(plan).stops) << name;
      EXPECT_TRUE(testing::StaysClear(price, Chosen(plan).path)) << name;
      EXPECT_EQ(Chosen(plan).goal.position, Chosen(plan).stops.back());
      EXPECT_EQ(Chosen(plan).goal.kind, GoalKind::kSite);
      EXPECT_NEAR(Chosen(plan).duration_s, plan.trajectory.duration_s, kRounding);
      EXPECT_NEAR(Chosen(plan).length_m, plan.trajectory.length_m, kRounding);
      EXPECT_TRUE(Chosen(plan).reward.has_value());
      EXPECT_TRUE(SamplesSites(plan));
    }
  }
}

TEST(SamplingStrategy, SamplesWhereItStands) {
  const Belief belief = SiteBelief(OpenArt(1, 1));
  const Plan plan = PlanOf(belief, SiteOptionsOf("lhr", belief.geometry()));
  EXPECT_EQ(plan.chosen, 0);
  EXPECT_NEAR(plan.trajectory.duration_s, 2.0, kRounding);
  EXPECT_EQ(plan.trajectory.length_m, 0.0);
}

TEST(SamplingStrategy, TheSameRequestGivesTheSameBytes) {
  const Belief belief = SiteBelief(kRoom);
  for (const char* name : {"lhr", "random_sampling", "sweep", "ipp_reward"}) {
    const PlanningOptions options = SiteOptionsOf(name, belief.geometry());
    EXPECT_EQ(PlanOf(belief, options, 3), PlanOf(belief, options, 3)) << name;
  }
}

TEST(SamplingStrategy, OnlyRandomSamplingFollowsTheSeed) {
  const Belief belief = SiteBelief(kRoom);
  for (const char* name : {"lhr", "random_sampling", "sweep", "ipp_reward"}) {
    const PlanningOptions options = SiteOptionsOf(name, belief.geometry());
    const bool same =
        PlanOf(belief, options, 3).trajectory == PlanOf(belief, options, 4).trajectory;
    EXPECT_EQ(same, std::string(name) != "random_sampling") << name;
  }
}

TEST(SamplingStrategy, RefusesToPlanForARobotOutsideTheRegion) {
  const Belief belief = SiteBelief(OpenArt(10, 10));
  PlanningOptions options = SiteOptionsOf("lhr", belief.geometry());
  options.sites.region = Rectangle{{0.3, 0.3}, {0.8, 0.8}};
  const auto plan = TryPlan(belief, For("r"), options);
  EXPECT_TRUE(absl::IsFailedPrecondition(plan.status()));
  EXPECT_THAT(std::string(plan.status().message()), HasSubstr("OUTSIDE_REGION"));
}

TEST(SamplingStrategy, OnTheEdgeOfTheRegionIsInside) {
  const Belief belief = SiteBelief(OpenArt(10, 10, {5, 5}));
  PlanningOptions options = SiteOptionsOf("lhr", belief.geometry());
  options.sites.region = Rectangle{{0.3, 0.3}, {0.6, 0.6}};
  PlanRequest request = For("r");
  request.start = Pose2{0.6, 0.3, 0.0};
  EXPECT_TRUE(TryPlan(belief, request, options).ok());
  request.start = Pose2{0.6 + 1e-6, 0.3, 0.0};
  EXPECT_TRUE(absl::IsFailedPrecondition(TryPlan(belief, request, options).status()));
}

TEST(SamplingStrategy, WithoutARegionSitesCoverTheMap) {
  const Belief belief = SiteBelief(OpenArt(20, 10));
  PlanningOptions options = SiteOptionsOf("ipp_reward", belief.geometry());
  options.sites.region.reset();
  options.sites.spacing_m = 0.5;
  options.sites.reward = SamplingReward::kConcentrationPerTime;
  EXPECT_THAT(Simulate(belief, options).samples, SizeIs(8));
}

TEST(SamplingStrategy, DrivesHomeOnRequestWithoutAStop) {
  Belief belief = SiteBelief(OpenArt(20, 10, {15, 5}));
  belief.robots["r"].first_place = belief.geometry().Center({2, 2});
  for (const char* name : {"lhr", "random_sampling", "sweep", "ipp_reward"}) {
    PlanRequest request = For("r");
    request.go_home = true;
    const auto plan = TryPlan(belief, request, SiteOptionsOf(name, belief.geometry()));
    ASSERT_TRUE(plan.ok()) << plan.status();
    EXPECT_EQ(plan->phase, MissionPhase::kReturning) << name;
    EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kHome);
    for (const Waypoint& waypoint : plan->trajectory.waypoints) EXPECT_EQ(waypoint.dwell_s, 0.0);
  }
}

TEST(SamplingStrategy, DrivesHomeByOrderAndSaysWhy) {
  Belief belief = SiteBelief(OpenArt(20, 10, {15, 5}));
  belief.robots["r"].first_place = belief.geometry().Center({2, 2});
  belief.robots["r"].state.ordered_home = true;
  const auto plan = TryPlan(belief, For("r"), SiteOptionsOf("lhr", belief.geometry()));
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kHome);
  EXPECT_NE(plan->explanation.find("ordered the robot home"), std::string::npos);
}

TEST(SamplingStrategy, DrivesHomeFromOutsideTheRegion) {
  Belief belief = SiteBelief(OpenArt(20, 10));
  belief.robots["r"].first_place = belief.geometry().Center({9, 2});
  PlanningOptions options = SiteOptionsOf("lhr", belief.geometry());
  options.sites.region = Rectangle{{0.5, 0.0}, {1.0, 0.5}};
  PlanRequest request = For("r");
  request.go_home = true;
  EXPECT_TRUE(TryPlan(belief, request, options).ok());
}

TEST(SamplingStrategy, ReturnsBeforeItsMissionIsComplete) {
  Belief belief = SiteBelief(OpenArt(12, 1));
  belief.robots["r"].first_place = belief.geometry().Center({0, 0});
  testing::MovePose(belief, belief.geometry().Center({11, 0}));
  std::vector<Cell> all;
  for (int x = 0; x < 12; ++x) all.push_back({x, 0});
  testing::SetSampled(belief, all);
  PlanningOptions options = SiteOptionsOf("lhr", belief.geometry());
  EXPECT_EQ(PlanOf(belief, options).phase, MissionPhase::kComplete);
  options.return_home = true;
  EXPECT_EQ(PlanOf(belief, options).phase, MissionPhase::kReturning);
  testing::MovePose(belief, belief.geometry().Center({0, 0}));
  EXPECT_EQ(PlanOf(belief, options).phase, MissionPhase::kComplete);
}

TEST(SamplingStrategy, WhoIsOutsideTheRegionWhenNothingIsLeftIsDone) {
  Belief belief = SiteBelief(OpenArt(12, 1));
  belief.robots["r"].first_place = belief.geometry().Center({0, 0});
  std::vector<Cell> all;
  for (int x = 0; x < 12; ++x) all.push_back({x, 0});
  testing::SetSampled(belief, all);
  PlanningOptions options = SiteOptionsOf("lhr", belief.geometry());
  options.return_home = true;
  options.sites.region = Rectangle{{0.6, 0.0}, {1.2, 0.3}};
  testing::MovePose(belief, belief.geometry().Center({0, 0}));
  EXPECT_EQ(PlanOf(belief, options).phase, MissionPhase::kComplete);
  testing::MovePose(belief, belief.geometry().Center({3, 0}));
  EXPECT_EQ(PlanOf(belief, options).phase, MissionPhase::kReturning);
}

TEST(SamplingStrategy, ReturnsWhenItsBudgetIsSpent) {
  Belief belief = SiteBelief(OpenArt(60, 1, {30, 0}));
  RobotRecord& robot = belief.robots["r"];
  robot.first_place = belief.geometry().Center({0, 0});
  robot.travelled_m = 3.0;
  PlanningOptions options = SiteOptionsOf("sweep", belief.geometry());
  testing::SetSampled(belief, {{0, 0}});
  options.travel_budget_m = 6.4;  // 3.4 m left; to the first site and home are 3.0 + 0.11 m
  EXPECT_EQ(PlanOf(belief, options).phase, MissionPhase::kSampling);
  options.travel_budget_m = 6.0;
  const Plan plan = PlanOf(belief, options);
  EXPECT_EQ(plan.phase, MissionPhase::kReturning);
  EXPECT_EQ(Chosen(plan).goal.kind, GoalKind::kHome);
}

TEST(SamplingStrategy, LeavesOutWhatOthersAreAboutToSampleAndWaitsForThem) {
  Belief belief = SiteBelief(OpenArt(20, 1));
  const PlanningOptions options = SiteOptionsOf("lhr", belief.geometry());
  std::vector<Cell> sampled;
  for (int x = 0; x < 20; ++x) {
    if (x != 5 && x != 15) sampled.push_back({x, 0});
  }
  testing::SetSampled(belief, sampled);
  testing::AddOtherRobot(belief, "other", {belief.geometry().Center({15, 0})});
  const Plan plan = PlanOf(belief, options);
  EXPECT_EQ(testing::CellsOf(belief.geometry(), Chosen(plan).stops),
            std::vector<Cell>({Cell{5, 0}}));
  testing::SetSampled(belief, {{5, 0}});
  const Plan waiting = PlanOf(belief, options);
  EXPECT_EQ(waiting.chosen, -1);
  EXPECT_EQ(waiting.end, PlanEnd::kAllGoalsRejected);
  EXPECT_EQ(waiting.phase, MissionPhase::kSampling) << "the other may fail";
}

TEST(SamplingStrategy, SetAsideSitesAreDoneWith) {
  Belief belief = SiteBelief(OpenArt(3, 1));
  testing::SetSampled(belief, {{0, 0}, {1, 0}});
  const Point2 place = belief.geometry().Center({2, 0});
  belief.set_aside.push_back(
      {{GoalKind::kSite, {2, 0}, place, place, 0}, "reported blocked", 1'000'000'000});
  const Plan plan = PlanOf(belief, SiteOptionsOf("lhr", belief.geometry()));
  EXPECT_EQ(plan.phase, MissionPhase::kComplete);
  EXPECT_EQ(plan.rejected.back().reason, RejectionReason::kSetAside);
}

TEST(SamplingStrategy, LeadsOutOfTheInflatedZoneFirst) {
  const testing::GridArt art = {"........",  //
                                "........",  //
                                "iiiiiiii",  //
                                "iiiiiiii"};
  Belief belief = SiteBelief(art);
  testing::MovePose(belief, belief.geometry().Center({2, 0}));
  const Plan plan = PlanOf(belief, SiteOptionsOf("sweep", belief.geometry()));
  ASSERT_EQ(plan.chosen, 0);
  EXPECT_TRUE(plan.start_escaped);
  EXPECT_EQ(Chosen(plan).path.front(), belief.geometry().Center({2, 0}));
  EXPECT_NEAR(Chosen(plan).length_m, plan.trajectory.length_m, kRounding);
}

TEST(SamplingStrategy, WithoutAWayOutTheRobotStays) {
  Belief belief = SiteBelief({"###", "#S#", "###"});
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(belief.geometry(), 0);
  const Plan plan = PlanOf(belief, SiteOptionsOf("lhr", belief.geometry()));
  EXPECT_EQ(plan.end, PlanEnd::kStartOccupied);
  EXPECT_EQ(plan.chosen, -1);
  EXPECT_FALSE(plan.explanation.empty());
}

TEST(SamplingStrategy, StoppedBeforeItHasAPlanItSaysSo) {
  const Belief belief = SiteBelief(kRoom);
  const auto plan =
      TryPlan(belief, For("r"), SiteOptionsOf("lhr", belief.geometry()), [] { return true; });
  EXPECT_TRUE(absl::IsDeadlineExceeded(plan.status())) << plan.status();
}

TEST(SamplingStrategy, AnUnknownRobotIsNotFound) {
  const Belief belief = SiteBelief(kRoom);
  EXPECT_TRUE(absl::IsNotFound(
      TryPlan(belief, For("nobody"), SiteOptionsOf("lhr", belief.geometry())).status()));
}

TEST(SamplingStrategy, ExplainsItself) {
  Belief belief = SiteBelief(OpenArt(5, 1));
  testing::SetSampled(belief, {{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  EXPECT_EQ(PlanOf(belief, SiteOptionsOf("sweep", belief.geometry())).explanation,
            "Drive 0.4 m and sample at 1 site, the last at (0.5, 0.1), until 2 s from now: site 5 "
            "of 5 of the sweep.");
}

}  // namespace sampling_strategy_test
}  // namespace plumescout
