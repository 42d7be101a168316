// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/team/team_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/plan/plan_start.h"
#include "core/plan/trajectory_timing.h"
#include "tests/support/corridor_team.h"

namespace plumescout {
namespace team_plan_test {

using testing::CorridorTeam;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

struct Prize {
  double x_m;
  double worth_nats;
};

// Each robot goes for the prize that is worth most a second, of those that nobody goes to.
class Prizes : public Strategy {
 public:
  explicit Prizes(std::vector<Prize> prizes) : prizes_(std::move(prizes)) {}

  using Strategy::Plan;
  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop, const PlanListener&) const override {
    if (stop()) return StoppedBeforeAnyPath();
    const auto robot = belief.robots.find(request.robot);
    if (robot == belief.robots.end()) return absl::NotFoundError("no such robot");
    plumescout::Plan plan;
    plan.robot = request.robot;
    plan.seed = request.seed;
    const Point2 place = robot->second.state.pose.position();
    double best = 0.0;
    for (const Prize& prize : prizes_) {
      const Point2 at = CorridorTeam::At(prize.x_m);
      bool taken = false;
      for (const GoalClaim& claim : belief.claims) {
        taken = taken || (claim.robot != request.robot && claim.goal.position == at);
      }
      if (taken) continue;
      Candidate candidate;
      candidate.goal = {GoalKind::kInformation, {}, at, at, 0};
      candidate.path = {place, at};
      candidate.duration_s = TimeTrajectory(candidate.path, 0.0, PlanningOptions()).duration_s;
      candidate.expected_information_nats = prize.worth_nats;
      const double rate = prize.worth_nats / candidate.duration_s;
      if (rate <= best) continue;
      best = rate;
      plan.chosen = 0;
      plan.trajectory = TimeTrajectory(candidate.path, 0.0, PlanningOptions());
      plan.candidates = {std::move(candidate)};
    }
    return plan;
  }

 private:
  std::vector<Prize> prizes_;
};

// As Prizes, but that one robot cannot be planned for.
class PrizesBut : public Prizes {
 public:
  PrizesBut(RobotId robot, std::vector<Prize> prizes)
      : Prizes(std::move(prizes)), robot_(std::move(robot)) {}

  using Strategy::Plan;
  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop,
                                        const PlanListener& improved) const override {
    if (request.robot == robot_) return absl::FailedPreconditionError("it has no pose");
    return Prizes::Plan(belief, request, stop, improved);
  }

 private:
  RobotId robot_;
};

double GoalOf(const Plan& plan) { return plan.candidates.at(0).goal.position.x_m; }

// "b" is a little nearer to the first prize, and much nearer to the other.
CorridorTeam Two() {
  CorridorTeam team;
  team.Stands("a", 3.0);
  team.Stands("b", 4.9);
  return team;
}
const std::vector<Prize> kTwoPrizes = {{4.0, 10.0}, {7.0, 12.0}};

TEST(PlanTeam, TheBestGoesFirstAndTheOthersKnowItsPlan) {
  const auto team = PlanTeam(Prizes(kTwoPrizes), Two().belief, {}, NeverStop());
  ASSERT_TRUE(team.ok()) << team.status();
  ASSERT_EQ(team->plans.size(), 2U);
  EXPECT_EQ(team->plans[0].robot, "b");
  EXPECT_EQ(GoalOf(team->plans[0]), 4.0);
  EXPECT_EQ(GoalOf(team->plans[1]), 7.0) << "what is left";
  EXPECT_EQ(team->order_count, 1);
  EXPECT_EQ(team->search_count, 3) << "the second's plan had to be searched for again";
}

TEST(PlanTeam, AnotherOrderIsTakenIfItIsWorthMore) {
  TeamRequest request;
  request.max_order_count = 10;
  const auto team = PlanTeam(Prizes(kTwoPrizes), Two().belief, request, NeverStop());
  ASSERT_TRUE(team.ok()) << team.status();
  EXPECT_EQ(team->plans[0].robot, "a");
  EXPECT_EQ(GoalOf(team->plans[0]), 4.0);
  EXPECT_EQ(GoalOf(team->plans[1]), 7.0);
  EXPECT_EQ(team->order_count, 2) << "two robots have no more orders";
  EXPECT_EQ(team->value.busy, 2);
  EXPECT_NEAR(team->value.merit, ValueOf(team->plans, PlanningOptions()).merit, 1e-12);
}

TEST(PlanTeam, TheSameRequestGivesTheSameBytesAndASeedGivesEachItsOwn) {
  TeamRequest request;
  request.seed = 7;
  const auto once = PlanTeam(Prizes(kTwoPrizes), Two().belief, request, NeverStop());
  const auto again = PlanTeam(Prizes(kTwoPrizes), Two().belief, request, NeverStop());
  ASSERT_TRUE(once.ok() && again.ok());
  EXPECT_EQ(once->plans, again->plans);
  EXPECT_NE(once->plans[0].seed, once->plans[1].seed);
}

TEST(PlanTeam, WhoIsNamedIsPlannedForThoughItHasAPlan) {
  CorridorTeam team = Two();
  team.Drives("a", 9.0);
  EXPECT_EQ(PlanTeam(Prizes(kTwoPrizes), team.belief, {}, NeverStop())->plans.size(), 1U);
  TeamRequest request;
  request.robots = {"a"};
  const auto plans = PlanTeam(Prizes(kTwoPrizes), team.belief, request, NeverStop())->plans;
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_EQ(plans[0].robot, "a");
}

TEST(PlanTeam, NobodyFreeIsNoError) {
  CorridorTeam team = Two();
  team.Drives("a", 9.0);
  team.Drives("b", 9.0);
  const auto planned = PlanTeam(Prizes(kTwoPrizes), team.belief, {}, NeverStop());
  ASSERT_TRUE(planned.ok());
  EXPECT_THAT(planned->plans, IsEmpty());
}

TEST(PlanTeam, WhoCannotBePlannedForIsLeftOutAndTheOthersGetTheirs) {
  CorridorTeam three = Two();
  three.Stands("c", 8.5);
  const auto team = PlanTeam(PrizesBut("c", kTwoPrizes), three.belief, {}, NeverStop());
  ASSERT_TRUE(team.ok()) << team.status();
  ASSERT_EQ(team->plans.size(), 2U);
  EXPECT_EQ(GoalOf(team->plans[0]), 4.0);
  EXPECT_EQ(GoalOf(team->plans[1]), 7.0);
  EXPECT_THAT(team->left_out, ElementsAre(LeftOut{"c", "it has no pose"}));
  EXPECT_EQ(team->order_count, 1);
}

TEST(PlanTeam, WhoIsLeftOutKeepsItsPlanAndItsGoal) {
  CorridorTeam three = Two();
  three.Stands("c", 8.5);
  three.Drives("c", 4.0);
  const Point2 first_prize = CorridorTeam::At(4.0);
  three.belief.claims = {{"c", 1, {GoalKind::kInformation, {}, first_prize, first_prize, 0}, 0}};
  TeamRequest request;
  request.robots = {"a", "b", "c"};
  const auto team = PlanTeam(PrizesBut("c", kTwoPrizes), three.belief, request, NeverStop());
  ASSERT_TRUE(team.ok()) << team.status();
  ASSERT_EQ(team->plans.size(), 2U);
  EXPECT_EQ(team->plans[0].robot, "b") << "it is nearer to what \"c\" leaves";
  EXPECT_EQ(GoalOf(team->plans[0]), 7.0);
  EXPECT_EQ(team->plans[1].chosen, -1);
  EXPECT_THAT(team->left_out, ElementsAre(LeftOut{"c", "it has no pose"}));
}

TEST(PlanTeam, MoreFreeRobotsThanATeamHasAreCounted) {
  CorridorTeam crowd;
  for (int i = 0; i <= kMostTeamRobots; ++i) crowd.Stands(absl::StrCat("r", i), 5.0);
  const absl::Status refused = PlanTeam(Prizes(kTwoPrizes), crowd.belief, {}, NeverStop()).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), StartsWith("TEAM_TOO_LARGE: 33 robots are free"));
}

TEST(PlanTeam, WhenTheFirstOrderIsStoppedWhoHasChosenGoes) {
  int polls = 0;
  const StopFn before_the_second = [&polls] { return ++polls > 4; };
  const auto team = PlanTeam(Prizes(kTwoPrizes), Two().belief, {}, before_the_second);
  ASSERT_TRUE(team.ok()) << team.status();
  ASSERT_EQ(team->plans.size(), 1U);
  EXPECT_EQ(team->plans[0].robot, "b");
  ASSERT_EQ(team->left_out.size(), 1U);
  EXPECT_EQ(team->left_out[0].robot, "a");
  EXPECT_THAT(team->left_out[0].why, StartsWith("DEADLINE_BEFORE_FIRST_PLAN"));
  EXPECT_EQ(team->order_count, 0);
}

GoalClaim ClaimOf(const RobotId& robot, double x_m) {
  const Point2 at = CorridorTeam::At(x_m);
  return {robot, 1, {GoalKind::kInformation, {}, at, at, 0}, 0};
}

TEST(PlanTeam, WhoHasChosenWhatOneWithoutTimeHasYetIsLeftOutToo) {
  CorridorTeam three = Two();
  three.Stands("c", 8.5);
  three.Drives("a", 4.0);
  three.belief.claims = {ClaimOf("a", 4.0)};
  TeamRequest request;
  request.robots = {"a", "b", "c"};
  // Three searches, and those of "a" and "c" after "b" has chosen: each asks twice.
  int polls = 0;
  const StopFn before_the_last = [&polls] { return ++polls > 10; };
  const auto team = PlanTeam(Prizes(kTwoPrizes), three.belief, request, before_the_last);
  ASSERT_TRUE(team.ok()) << team.status();
  ASSERT_EQ(team->plans.size(), 1U);
  EXPECT_EQ(team->plans[0].robot, "c");
  EXPECT_EQ(GoalOf(team->plans[0]), 7.0);
  ASSERT_EQ(team->left_out.size(), 2U);
  EXPECT_EQ(team->left_out[0].robot, "a");
  EXPECT_EQ(team->left_out[1].robot, "b");
  EXPECT_THAT(team->left_out[1].why, HasSubstr("against that of robot \"a\""));
}

TEST(PlanTeam, IfNobodyIsLeftWithAPlanItSaysWhoStoodInTheWay) {
  CorridorTeam two = Two();
  two.Drives("a", 4.0);
  two.belief.claims = {ClaimOf("a", 4.0)};
  TeamRequest request;
  request.robots = {"a", "b"};
  // Two searches, in which "b" gets the goal of "a"; none of "a" after that.
  int polls = 0;
  const StopFn before_the_second = [&polls] { return ++polls > 4; };
  const absl::Status status =
      PlanTeam(Prizes(kTwoPrizes), two.belief, request, before_the_second).status();
  EXPECT_TRUE(absl::IsDeadlineExceeded(status));
  EXPECT_THAT(std::string(status.message()), StartsWith("DEADLINE_BEFORE_FIRST_PLAN"));
  EXPECT_THAT(std::string(status.message()),
              HasSubstr("robot \"b\": its plan is against that of robot \"a\""));
  EXPECT_THAT(std::string(status.message()), Not(HasSubstr("robot \"a\": DEADLINE")));
}

TEST(PlanTeam, WithoutTimeForAnotherFirstOrderWhatStandsOfTheOneBeforeGoes) {
  CorridorTeam three = Two();
  three.Stands("c", 8.5);
  three.Drives("c", 7.0);
  three.belief.claims = {ClaimOf("c", 7.0)};
  TeamRequest request;
  request.robots = {"a", "b", "c"};
  // "a" and "b" ask twice, "c" once, and "a" twice more.
  int polls = 0;
  const StopFn before_the_next = [&polls] { return ++polls > 7; };
  const auto team = PlanTeam(PrizesBut("c", kTwoPrizes), three.belief, request, before_the_next);
  ASSERT_TRUE(team.ok()) << team.status();
  ASSERT_EQ(team->plans.size(), 1U);
  EXPECT_EQ(team->plans[0].robot, "b");
  EXPECT_EQ(GoalOf(team->plans[0]), 4.0);
  ASSERT_EQ(team->left_out.size(), 2U);
  EXPECT_EQ(team->left_out[0], (LeftOut{"c", "it has no pose"}));
  EXPECT_EQ(team->left_out[1].robot, "a") << "it would go where \"c\" goes";
  EXPECT_EQ(team->order_count, 0);
}

TEST(PlanTeam, BadRequestsAreRefused) {
  const auto refused = [](const TeamRequest& request) {
    return PlanTeam(Prizes(kTwoPrizes), Two().belief, request, NeverStop()).status();
  };
  EXPECT_THAT(std::string(refused({.robots = {"a", "b", "a"}}).message()),
              HasSubstr("\"a\" twice"));
  EXPECT_TRUE(absl::IsNotFound(refused({.robots = {"a", "z"}})));
  TeamRequest crowd;
  for (int i = 0; i <= kMostTeamRobots; ++i) crowd.robots.push_back(absl::StrCat("r", i));
  EXPECT_TRUE(absl::IsInvalidArgument(refused(crowd)));
  TeamRequest none;
  none.max_order_count = 0;
  EXPECT_TRUE(absl::IsInvalidArgument(refused(none)));
}

TEST(PlanTeam, WhenItIsStoppedTheOrdersThatEndedCount) {
  int polls = 0;
  const StopFn after_the_first = [&polls] { return ++polls > 7; };
  TeamRequest request;
  request.max_order_count = 10;
  const auto team = PlanTeam(Prizes(kTwoPrizes), Two().belief, request, after_the_first);
  ASSERT_TRUE(team.ok()) << team.status();
  EXPECT_EQ(team->order_count, 1);
  EXPECT_EQ(team->plans[0].robot, "b");
  const StopFn at_once = [] { return true; };
  EXPECT_TRUE(
      absl::IsDeadlineExceeded(PlanTeam(Prizes(kTwoPrizes), Two().belief, {}, at_once).status()));
}

}  // namespace team_plan_test
}  // namespace plumescout
