// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/composed_strategy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/gas/gas_map.h"
#include "lab/worlds/random_world.h"
#include "tests/support/goal_case.h"
#include "tests/support/rounds.h"
#include "tests/support/strategy_case.h"

namespace plumescout {
namespace composed_strategy_test {

using testing::BeliefFromArt;
using testing::Chosen;
using testing::For;
using ::testing::Ge;
using testing::GridArt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kRoom;
using ::testing::Not;
using ::testing::SizeIs;
using testing::SmallBelief;
using testing::TryPlan;

constexpr double kRounding = 1e-9;

Grid<float> Penalty(const Belief& belief) {
  Grid<float> penalty(belief.geometry(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < penalty.size(); ++i) {
    if ((*belief.traversable)[i] != 0) penalty[i] = 1.0F;
  }
  return penalty;
}

std::vector<Plan> PlansOnTheWay(const Belief& belief, const RobotId& robot,
                                const PlanningOptions& options, Plan& last) {
  std::vector<Plan> plans;
  const auto strategy = MakeStrategy(options);
  const auto plan = (*strategy)->Plan(belief, For(robot, 5), NeverStop(),
                                      [&](const Plan& better) { plans.push_back(better); });
  EXPECT_TRUE(plan.ok()) << plan.status();
  last = plan.value_or(Plan{});
  return plans;
}

TEST(Strategy, TellsOfBetterPlansOnTheWay) {
  PlanningOptions options = testing::XitGff();
  options.paths = PathKind::kAnytimeXit;
  const lab::RandomWorld world = lab::MakeRandomWorld(2, 3);
  Plan last;
  std::vector<Plan> plans = PlansOnTheWay(world.belief, world.robot, options, last);
  ASSERT_THAT(plans, Not(IsEmpty()));
  plans.push_back(last);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    EXPECT_EQ(plans[i].id, 0);
    EXPECT_THAT(plans[i].explanation, HasSubstr("Drive "));
    EXPECT_NEAR(plans[i].trajectory.length_m, Chosen(plans[i]).length_m, kRounding);
    if (i == 0) continue;
    for (const Candidate& candidate : plans[i].candidates) {
      for (const Candidate& before : plans[i - 1].candidates) {
        if (!(before.goal == candidate.goal)) continue;
        EXPECT_LE(candidate.cost, before.cost);
      }
    }
  }
}

TEST(Strategy, TellsOfNoneIfTheSearchHasNone) {
  Plan last;
  EXPECT_THAT(PlansOnTheWay(SmallBelief(kRoom), "r", {}, last), IsEmpty());
  EXPECT_THAT(last.candidates, SizeIs(2));
}

TEST(Strategy, PlansToTheCheapestFrontier) {
  const Belief belief = SmallBelief(kRoom);
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r", 5));
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(plan->robot, "r");
  EXPECT_EQ(plan->strategy, "xit_gff");
  EXPECT_EQ(plan->belief_revision, 1);
  EXPECT_EQ(plan->seed, 5U);
  EXPECT_EQ(plan->phase, MissionPhase::kExploring);
  EXPECT_EQ(plan->end, PlanEnd::kAllGoalsReached);
  EXPECT_TRUE(plan->field_flat);
  EXPECT_FALSE(plan->start_escaped);
  ASSERT_THAT(plan->candidates, SizeIs(2));
  EXPECT_EQ(Chosen(*plan).goal.cell.x, 1) << "the west is nearer";
  for (const Candidate& candidate : plan->candidates) {
    EXPECT_GE(candidate.cost, Chosen(*plan).cost);
  }
  EXPECT_THAT(plan->explanation, HasSubstr("an occupancy frontier"));
  EXPECT_GT(plan->effort.samples, 0);
}

// Into a room with unseen parts, in a field of this smoothness.
std::string WhyThere(double prior_precision_per_ppm2) {
  Belief belief = SmallBelief(kRoom);
  MissionOptions mission = *belief.options;
  mission.gas = PublishedGasOptions();
  mission.gas.prior_precision_per_ppm2 = prior_precision_per_ppm2;
  belief.options = std::make_shared<const MissionOptions>(mission);
  GasMap gas(mission.gas);
  EXPECT_TRUE(gas.Refresh(*belief.occupancy, 0).ok());
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm());
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2());
  belief.gas_what_if = gas.what_if();
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r", 5), PlanningOptions());
  EXPECT_TRUE(plan.ok()) << plan.status();
  return plan.ok() ? plan->explanation : "";
}

TEST(Strategy, CountsWhatIsUnseenInTheUnitOfTheField) {
  EXPECT_THAT(WhyThere(3.0), HasSubstr("nats and 20 for what is unseen"));
  // ln(1 + 10 * 6.4227) / ln(1 + 10 * 0.30431) = 2.9906 times as much
  EXPECT_THAT(WhyThere(0.1), HasSubstr("nats and 59.8 for what is unseen"));
}

TEST(Strategy, TimesTheTrajectoryOfTheChosenCandidate) {
  PlanningOptions options = testing::XitGff();
  options.speed_mps = 0.5;
  options.dwell_s = 2.0;
  const absl::StatusOr<Plan> plan = TryPlan(SmallBelief(kRoom), For("r"), options);
  ASSERT_TRUE(plan.ok());
  const Candidate& chosen = Chosen(*plan);
  ASSERT_THAT(plan->trajectory.waypoints, SizeIs(chosen.path.size()));
  EXPECT_NEAR(plan->trajectory.length_m, chosen.length_m, kRounding);
  const auto legs = static_cast<double>(chosen.path.size() - 1);
  EXPECT_NEAR(plan->trajectory.duration_s, chosen.length_m / 0.5 + 2.0 * legs, kRounding);
}

TEST(Strategy, CollidesWithNothingAndReachesAllItOffersInRandomHalls) {
  for (int seed = 1; seed <= support::Rounds(8); ++seed) {
    const lab::RandomWorld world = lab::MakeRandomWorld(seed, 1);
    const absl::StatusOr<Plan> plan = TryPlan(world.belief, For(world.robot, seed));
    ASSERT_TRUE(plan.ok()) << plan.status();
    EXPECT_EQ(plan->end, PlanEnd::kAllGoalsReached);
    EXPECT_THAT(plan->candidates, SizeIs(Ge(1)));
    for (const Candidate& candidate : plan->candidates) {
      EXPECT_TRUE(testing::StaysClear(Penalty(world.belief), candidate.path)) << "seed " << seed;
      EXPECT_EQ(candidate.path.back(), candidate.goal.position);
      EXPECT_NEAR(candidate.cost, candidate.information_penalty, kRounding) << "alpha is 0";
      EXPECT_GE(candidate.mean_ucb, 0.0);
      EXPECT_LE(candidate.mean_ucb, 1.0);
    }
  }
}

TEST(Strategy, KeepsTheGoalItDrivesToUnlessAnotherIsBetterByTheMargin) {
  Belief belief = SmallBelief(kRoom);
  const absl::StatusOr<Plan> free = TryPlan(belief, For("r"));
  ASSERT_TRUE(free.ok());
  ASSERT_THAT(free->candidates, SizeIs(2));
  const Candidate& other = free->candidates[static_cast<std::size_t>(1 - free->chosen)];
  belief.claims = {{"r", 1, other.goal, belief.sample_time_ns + 1}};

  PlanningOptions options = testing::XitGff();
  options.commitment_margin_share = 1.0;
  const absl::StatusOr<Plan> kept = TryPlan(belief, For("r"), options);
  ASSERT_TRUE(kept.ok());
  EXPECT_TRUE(kept->goal_kept);
  EXPECT_EQ(Chosen(*kept).goal, other.goal);

  options.commitment_margin_share = 0.01;
  const absl::StatusOr<Plan> changed = TryPlan(belief, For("r"), options);
  ASSERT_TRUE(changed.ok());
  EXPECT_FALSE(changed->goal_kept);
  EXPECT_EQ(Chosen(*changed).goal, Chosen(*free).goal);
}

TEST(Strategy, SaysHowLongEachCandidateTakes) {
  PlanningOptions options = testing::XitGff();
  options.speed_mps = 0.5;
  const absl::StatusOr<Plan> plan = TryPlan(SmallBelief(kRoom), For("r"), options);
  ASSERT_TRUE(plan.ok());
  for (const Candidate& candidate : plan->candidates) {
    EXPECT_NEAR(candidate.duration_s, candidate.length_m / 0.5, kRounding);
    EXPECT_FALSE(candidate.expected_information_nats.has_value()) << "nobody asked";
  }
  EXPECT_NEAR(Chosen(*plan).duration_s, plan->trajectory.duration_s, kRounding);
}

TEST(Strategy, GivesTheSameBytesForTheSameRequest) {
  const lab::RandomWorld world = lab::MakeRandomWorld(3, 1);
  PlanningOptions options = testing::XitGff();
  options.draw_goals = true;
  for (const std::uint64_t seed : {0, 9}) {
    const absl::StatusOr<Plan> first = TryPlan(world.belief, For(world.robot, seed), options);
    const absl::StatusOr<Plan> second = TryPlan(world.belief, For(world.robot, seed), options);
    ASSERT_TRUE(first.ok() && second.ok());
    EXPECT_EQ(*first, *second);
  }
}

TEST(Strategy, DerivesAnotherSeedForEveryMissionRobotAndPlan) {
  Belief belief = SmallBelief(kRoom);
  std::set<std::uint64_t> seeds;
  const auto note_seed = [&](const RobotId& robot) {
    const absl::StatusOr<Plan> plan = TryPlan(belief, For(robot));
    ASSERT_TRUE(plan.ok());
    EXPECT_NE(plan->seed, 0U);
    seeds.insert(plan->seed);
    EXPECT_EQ(*TryPlan(belief, For(robot, plan->seed)), *plan) << "the seed repeats the plan";
  };
  note_seed("r");
  belief.robots["r"].plans_issued = 1;
  note_seed("r");
  belief.robots["s"] = belief.robots["r"];
  belief.robots["s"].state.id = "s";
  belief.robots["s"].state.pose.x_m -= 0.25;  // beside it, not in it
  note_seed("s");
  MissionOptions mission = *belief.options;
  mission.seed = 2;
  belief.options = std::make_shared<const MissionOptions>(mission);
  note_seed("r");
  EXPECT_EQ(seeds.size(), 4U);
}

TEST(Strategy, StartsWhereTheRequestSays) {
  PlanRequest request = For("r");
  request.start = Pose2{1.03, 0.34, 0.0};
  const absl::StatusOr<Plan> plan = TryPlan(SmallBelief(kRoom), request);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(Chosen(*plan).path.front(), (Point2{1.03, 0.34}));
  EXPECT_EQ(Chosen(*plan).goal.cell.x, 14) << "the east is nearer";
}

TEST(Strategy, DrivesOutOfTheInflatedZoneFirst) {
  const GridArt art = {"##########",  //
                       "#iiiiiiiii",  //
                       "#iSi.....?",  //
                       "#iii.....?",  //
                       "#iii.....?",  //
                       "#iiiiiiiii",  //
                       "##########"};
  Belief belief = SmallBelief(art);
  Grid<std::uint8_t> traversable = *belief.traversable;
  traversable[testing::CellInArt(art, 'S')] = 0;
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(traversable);
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r"));
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_TRUE(plan->start_escaped);
  const Candidate& chosen = Chosen(*plan);
  EXPECT_EQ(chosen.path.front(), belief.geometry().Center(testing::CellInArt(art, 'S')));
  EXPECT_EQ(chosen.goal.cell.x, 8);
  double length_m = 0.0;
  for (std::size_t i = 1; i < chosen.path.size(); ++i) {
    length_m += Distance_m(chosen.path[i - 1], chosen.path[i]);
  }
  EXPECT_NEAR(chosen.length_m, length_m, kRounding);
  EXPECT_TRUE(std::isfinite(chosen.cost));
  EXPECT_TRUE(std::isfinite(chosen.information_penalty));
  EXPECT_THAT(plan->explanation, HasSubstr("first out of the margin"));
}

TEST(Strategy, StaysIfTheRobotIsWalledIn) {
  Belief belief = SmallBelief({"#####",  //
                               "##S##",  //
                               "#####"});
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(belief.geometry(), 0);
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r"));
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->end, PlanEnd::kStartOccupied);
  EXPECT_EQ(plan->chosen, -1);
  EXPECT_THAT(plan->trajectory.waypoints, IsEmpty());
}

TEST(Strategy, StaysIfTheRobotsCellIsAllThereIs) {
  const absl::StatusOr<Plan> plan = TryPlan(SmallBelief({"###",  //
                                                         "#S#",  //
                                                         "###"}),
                                            For("r"));
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->end, PlanEnd::kNoGoals);
  EXPECT_THAT(plan->explanation, HasSubstr("Stay"));
}

TEST(Strategy, ProbesGasFrontiers) {
  const GridArt art = {"#########",  //
                       "#ggg....#",  //
                       "#gSg....#",  //
                       "#ggg....#",  //
                       "#########"};
  testing::GoalCase c(art);
  c.AddGas(art, 50.0F);
  PlanningOptions options = testing::XitGff();
  options.min_goal_distance_m = 0.1;
  const absl::StatusOr<Plan> plan = TryPlan(c.belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->phase, MissionPhase::kGasProbing);
  EXPECT_FALSE(plan->field_flat);
  EXPECT_GT(Chosen(*plan).mean_concentration_ppm, 0.0);
}

TEST(Strategy, SaysWhatItPassedOver) {
  Belief belief = SmallBelief(kRoom);
  const absl::StatusOr<Plan> free = TryPlan(belief, For("r"));
  ASSERT_TRUE(free.ok());
  const Goal taken = Chosen(*free).goal;
  belief.claims = {{"other", 1, taken, 1000}};
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r"));
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(Chosen(*plan).goal.cell.x, 14) << "the other one";
  ASSERT_THAT(plan->rejected, SizeIs(1));
  EXPECT_EQ(plan->rejected[0].goal, taken);
  EXPECT_EQ(plan->rejected[0].reason, RejectionReason::kClaimed);
}

TEST(Strategy, WithoutTheGuardMayMissGoalsAndSaysSo) {
  PlanningOptions options = testing::XitGff();
  options.grid_guard = false;
  options.sample_count = 1;
  options.nearest_sample_count = 1;
  const absl::StatusOr<Plan> plan = TryPlan(SmallBelief(kRoom), For("r", 1), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->end, PlanEnd::kQueueExhausted);
  EXPECT_THAT(plan->rejected, Not(IsEmpty()));
  EXPECT_EQ(plan->rejected.back().reason, RejectionReason::kUnreachable);
  options.grid_guard = true;
  const absl::StatusOr<Plan> guarded = TryPlan(SmallBelief(kRoom), For("r", 1), options);
  ASSERT_TRUE(guarded.ok());
  EXPECT_EQ(guarded->end, PlanEnd::kAllGoalsReached);
  EXPECT_GT(guarded->effort.goals_by_guard, 0);
}

TEST(Strategy, KeepsToTheEdgeBudgetAndStaysRepeatable) {
  const lab::RandomWorld world = lab::MakeRandomWorld(2, 3);
  PlanRequest request = For(world.robot, 4);
  for (const int budget : {1, 200, 800}) {
    request.max_edge_evaluations = budget;
    const absl::StatusOr<Plan> plan = TryPlan(world.belief, request);
    ASSERT_TRUE(plan.ok()) << plan.status();
    EXPECT_EQ(plan->end, PlanEnd::kStopped);
    EXPECT_EQ(plan->effort.edges_evaluated, budget);
    EXPECT_EQ(*plan, *TryPlan(world.belief, request));
  }
}

TEST(Strategy, RefusesRobotsAndStartsItCannotPlanFor) {
  Belief belief = SmallBelief(kRoom);
  EXPECT_EQ(TryPlan(belief, For("nobody")).status().code(), absl::StatusCode::kNotFound);
  PlanRequest request = For("r");
  for (const Pose2 start : {Pose2{NAN, 0.5, 0.0}, Pose2{0.5, INFINITY, 0.0}, Pose2{0.5, 0.5, NAN},
                            Pose2{-0.1, 0.5, 0.0}, Pose2{1e300, 0.5, 0.0}}) {
    request.start = start;
    EXPECT_EQ(TryPlan(belief, request).status().code(), absl::StatusCode::kInvalidArgument);
  }
  belief.robots["r"].state.has_pose = false;
  EXPECT_EQ(TryPlan(belief, For("r")).status().code(), absl::StatusCode::kFailedPrecondition);
}

TEST(Strategy, OnAnEmptyMapRefusesTheStart) {
  Belief belief = BeliefFromArt({});
  belief.robots["r"].state.has_pose = true;
  EXPECT_EQ(TryPlan(belief, For("r")).status().code(), absl::StatusCode::kInvalidArgument);
}

// A corridor that is open in the east, where another robot stands in the way.
TEST(Strategy, SaysWhomARobotThatStaysWaitsFor) {
  Belief belief = SmallBelief({"##############################",  //
                               ".............................?",  //
                               "S............................?",  //
                               ".............................?",  //
                               "##############################"});
  RobotRecord other = belief.robots.at("r");
  other.state.id = "s";
  other.state.pose.x_m += 1.5;
  belief.robots["s"] = other;
  const auto plan = TryPlan(belief, For("r"));
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(plan->end, PlanEnd::kAllGoalsRejected);
  EXPECT_EQ(plan->waits_for, "s");
  EXPECT_THAT(plan->explanation, HasSubstr("waits until robot \"s\" has passed"));
  belief.robots.erase("s");
  EXPECT_EQ(TryPlan(belief, For("r"))->waits_for, "");
}

}  // namespace composed_strategy_test
}  // namespace plumescout
