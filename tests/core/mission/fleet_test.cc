// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/fleet.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/core/mission/fleet_case.h"

namespace plumescout {
namespace fleet_test {

using support::FleetOf;
using support::kMaxRobots;
using support::kSecond_ns;
using support::PlanTo;

Observation Numbered(std::int64_t sequence) {
  return {sequence, kSecond_ns, {1.0, 2.0, 0.0}, GasReading{1.0, 0.0}};
}

TEST(FleetRegister, RefusesOldLeasesBadRadiiAndTooManyRobots) {
  Fleet fleet = FleetOf({"a"});
  EXPECT_EQ(fleet.Register({"a", 0.2, 1}, kMaxRobots).code(),
            absl::StatusCode::kFailedPrecondition);
  EXPECT_TRUE(fleet.Register({"a", 0.2, 2}, kMaxRobots).ok());
  EXPECT_EQ(fleet.Register({"b", NAN, 1}, kMaxRobots).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(fleet.Register({"B!", 0.2, 1}, kMaxRobots).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(fleet.Register({"b", 0.2, 1}, 1).code(), absl::StatusCode::kResourceExhausted);
  EXPECT_FALSE(fleet.Knows("b"));
}

TEST(FleetRegister, RemembersOnlySoManyWhoHaveLeft) {
  constexpr int kMost = 4096;
  Fleet fleet;
  for (int i = 0; i < kMost; ++i) {
    const RobotId robot = absl::StrCat("r", i);
    ASSERT_TRUE(fleet.Register({robot, 0.2, 1}, 2).ok()) << i;
    ASSERT_TRUE(fleet.Remove(robot).ok());
  }
  EXPECT_TRUE(absl::IsResourceExhausted(fleet.Register({"one-more", 0.2, 1}, 2)));
  EXPECT_TRUE(fleet.Register({"r0", 0.2, 2}, 2).ok()) << "it was there before";
}

TEST(FleetRegister, RefusesAnEpochThatADoubleWouldNotHold) {
  Fleet fleet;
  for (const std::int64_t log_epoch : {std::int64_t{-1}, std::int64_t{1} << 53}) {
    const absl::Status status = fleet.Register({"a", 0.2, 1, log_epoch}, kMaxRobots);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(std::string(status.message()), testing::HasSubstr("log_epoch = "));
  }
  EXPECT_FALSE(fleet.Knows("a"));
  EXPECT_TRUE(fleet.Register({"a", 0.2, 1, (std::int64_t{1} << 53) - 1}, kMaxRobots).ok());
}

TEST(FleetLog, ContinuesWhileItIsEmptyOrTheSameOrNobodySays) {
  Fleet fleet = FleetOf({"a"});
  EXPECT_TRUE(fleet.LogContinues("nobody", 5));
  ASSERT_TRUE(fleet.Register({"a", 0.2, 2, 5}, kMaxRobots).ok());
  EXPECT_TRUE(fleet.LogContinues("a", 6));
  fleet.Advance("a", Numbered(1), false);
  EXPECT_TRUE(fleet.LogContinues("a", 5));
  EXPECT_TRUE(fleet.LogContinues("a", 0));
  EXPECT_FALSE(fleet.LogContinues("a", 6));
}

TEST(FleetLog, IsTheOneThatWasNamedLast) {
  Fleet fleet = FleetOf({"a"});
  fleet.Advance("a", Numbered(1), false);
  EXPECT_TRUE(fleet.LogContinues("a", 5));  // of the observation nobody said of which log it is
  ASSERT_TRUE(fleet.Register({"a", 0.2, 2, 5}, kMaxRobots).ok());
  ASSERT_TRUE(fleet.Register({"a", 0.2, 3}, kMaxRobots).ok());  // does not say
  EXPECT_FALSE(fleet.LogContinues("a", 6));
  ASSERT_TRUE(fleet.Register({"a", 0.2, 4, 6}, kMaxRobots).ok());
  EXPECT_FALSE(fleet.LogContinues("a", 5));
  ASSERT_TRUE(fleet.Remove("a").ok());
  EXPECT_FALSE(fleet.LogContinues("a", 5));  // its log goes on should it come back
  EXPECT_TRUE(fleet.LogContinues("a", 6));
}

TEST(FleetSequence, TakesTheNextNumberOnly) {
  Fleet fleet = FleetOf({"a"});
  EXPECT_EQ(fleet.CheckSequence("a", Numbered(0)).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(fleet.CheckSequence("a", Numbered(2)).code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(fleet.CheckSequence("b", Numbered(1)).code(), absl::StatusCode::kNotFound);
  ASSERT_TRUE(fleet.CheckSequence("a", Numbered(1)).ok());
  fleet.Advance("a", Numbered(1), false);
  EXPECT_EQ(fleet.CheckSequence("a", Numbered(1)).code(), absl::StatusCode::kAlreadyExists);
  EXPECT_EQ(*fleet.AppliedSequence("a"), 1);
}

TEST(FleetSequence, AGapStandsForAllItsNumbers) {
  Fleet fleet = FleetOf({"a"});
  Observation gap = Numbered(1);
  gap.payload = SequenceGap{1, 7};
  ASSERT_TRUE(fleet.CheckSequence("a", gap).ok());
  fleet.Advance("a", gap, false);
  EXPECT_EQ(*fleet.AppliedSequence("a"), 7);
  EXPECT_FALSE(fleet.Records().at("a").state.has_pose) << "a gap says nothing of the pose";
  EXPECT_EQ(fleet.CheckSequence("a", gap).code(), absl::StatusCode::kAlreadyExists);
}

TEST(FleetSequence, AGapMayOverlapWhatIsAppliedButNotBeMalformed) {
  Fleet fleet = FleetOf({"a"});
  fleet.Advance("a", Numbered(1), false);
  Observation gap = Numbered(1);
  gap.payload = SequenceGap{1, 4};
  EXPECT_TRUE(fleet.CheckSequence("a", gap).ok());
  gap.payload = SequenceGap{2, 4};
  EXPECT_EQ(fleet.CheckSequence("a", gap).code(), absl::StatusCode::kInvalidArgument);
  gap = Numbered(5);
  gap.payload = SequenceGap{5, 9};
  EXPECT_EQ(fleet.CheckSequence("a", gap).code(), absl::StatusCode::kFailedPrecondition);
}

TEST(FleetIssue, DoesNotHandOutAClaimedGoalTwice) {
  Fleet fleet = FleetOf({"a", "b"});
  ASSERT_TRUE(fleet.Issue(PlanTo("a", {1.0, 1.0}), 0).ok());
  EXPECT_EQ(fleet.Issue(PlanTo("b", {1.2, 1.0}), 0).status().code(), absl::StatusCode::kAborted);
  EXPECT_TRUE(fleet.Issue(PlanTo("b", {2.0, 1.0}), 0).ok());
  EXPECT_TRUE(fleet.Issue(PlanTo("a", {1.0, 1.1}), 0).ok()) << "its own claim is no obstacle";
}

TEST(FleetIssue, ClaimsEndWithAReportAndExpireWithoutOne) {
  Fleet fleet = FleetOf({"a", "b"});
  const PlanId plan = *fleet.Issue(PlanTo("a", {1.0, 1.0}), 0);
  EXPECT_EQ(fleet.Claims(0).size(), 1u);
  EXPECT_EQ(fleet.Claims(51 * kSecond_ns).size(), 0u);  // 2 x 10 s + 30 s
  ASSERT_TRUE(fleet.Report({"a", plan, ProgressOutcome::kAborted}).ok());
  EXPECT_TRUE(fleet.Claims(0).empty());
}

TEST(FleetReport, KnowsUnknownSupersededAndEndedPlans) {
  Fleet fleet = FleetOf({"a"});
  EXPECT_EQ(fleet.Report({"a", 1, ProgressOutcome::kReached}).status().code(),
            absl::StatusCode::kNotFound);
  const PlanId first = *fleet.Issue(PlanTo("a", {1.0, 1.0}), 0);
  const PlanId second = *fleet.Issue(PlanTo("a", {3.0, 1.0}), 0);
  EXPECT_EQ(fleet.Report({"a", first, ProgressOutcome::kReached}).status().code(),
            absl::StatusCode::kFailedPrecondition);
  EXPECT_TRUE(fleet.Report({"a", second, ProgressOutcome::kReached}).ok());
  EXPECT_EQ(fleet.Report({"a", second, ProgressOutcome::kReached}).status().code(),
            absl::StatusCode::kAlreadyExists);
}

TEST(FleetReport, CountsFallbacksInARowThatRevealedNothing) {
  Fleet fleet = FleetOf({"a"});
  const auto fallback = [&](double x_m) {
    const PlanId plan = *fleet.Issue(PlanTo("a", {x_m, 1.0}, GoalKind::kRandomFreeSpace), 0);
    EXPECT_TRUE(fleet.Report({"a", plan, ProgressOutcome::kReached}).ok());
    return fleet.Records().at("a").fruitless_fallbacks;
  };
  EXPECT_EQ(fallback(1.0), 1);
  ASSERT_TRUE(fleet.Issue(PlanTo("a", {5.0, 5.0}), 0).ok()) << "a frontier appeared";
  EXPECT_EQ(fallback(2.0), 1);
  EXPECT_EQ(fallback(3.0), 2);
}

TEST(FleetReport, CountsNoFallbackThatDidNotReachItsPlace) {
  Fleet fleet = FleetOf({"a"});
  for (const ProgressOutcome outcome : {ProgressOutcome::kBlocked, ProgressOutcome::kAborted}) {
    const PlanId plan = *fleet.Issue(PlanTo("a", {1.0, 1.0}, GoalKind::kRandomFreeSpace), 0);
    ASSERT_TRUE(fleet.Report({"a", plan, outcome}).ok());
    EXPECT_EQ(fleet.Records().at("a").fruitless_fallbacks, 0);
  }
}

TEST(FleetReport, SaysWhichGoalThePlanHad) {
  Fleet fleet = FleetOf({"a"});
  const PlanId plan = *fleet.Issue(PlanTo("a", {1.0, 2.0}), 0);
  const auto ended = fleet.Report({"a", plan, ProgressOutcome::kBlocked});
  ASSERT_TRUE(ended.ok());
  ASSERT_TRUE(ended->goal.has_value());
  EXPECT_EQ(ended->goal->position, (Point2{1.0, 2.0}));
  EXPECT_FALSE(ended->others_near);
}

TEST(FleetIssue, NobodyClaimsHomeAndNoMemoryKeepsFromIt) {
  Fleet fleet = FleetOf({"a", "b"});
  const PlanId plan = *fleet.Issue(PlanTo("a", {1.0, 1.0}, GoalKind::kHome), 0);
  EXPECT_TRUE(fleet.Claims(0).empty());
  EXPECT_TRUE(fleet.Issue(PlanTo("b", {1.0, 1.0}, GoalKind::kHome), 0).ok());
  EXPECT_EQ(fleet.Report({"a", plan, ProgressOutcome::kBlocked})->goal, std::nullopt);
}

TEST(FleetRecords, HoldTheFirstPlaceAndTheWaySinceThen) {
  Fleet fleet = FleetOf({"a"});
  EXPECT_FALSE(fleet.Records().at("a").first_place.has_value());
  Observation observation = Numbered(1);
  observation.pose = {1.0, 2.0, 0.0};
  fleet.Advance("a", observation, true);
  EXPECT_FALSE(fleet.Records().at("a").first_place.has_value()) << "a refused pose is no place";
  fleet.Advance("a", observation, false);
  observation.pose = {4.0, 6.0, 0.0};
  fleet.Advance("a", observation, false);
  ASSERT_TRUE(fleet.Register({"a", 0.2, 2}, kMaxRobots).ok()) << "it comes back";
  EXPECT_EQ(fleet.Records().at("a").first_place, (Point2{1.0, 2.0}));
  EXPECT_EQ(fleet.Records().at("a").travelled_m, 5.0);
}

TEST(FleetRecords, HoldTheTrajectoryOfTheLivePlan) {
  Fleet fleet = FleetOf({"a"});
  EXPECT_EQ(fleet.Records().at("a").live_trajectory, nullptr);
  const PlanId plan = *fleet.Issue(PlanTo("a", {1.0, 1.0}), 0);
  ASSERT_NE(fleet.Records().at("a").live_trajectory, nullptr);
  EXPECT_EQ(fleet.Records().at("a").live_trajectory->duration_s, 10.0);
  EXPECT_EQ(fleet.Records().at("a").live_goal.value().position, (Point2{1.0, 1.0}));
  EXPECT_EQ(fleet.Records().at("a").last_plan, plan);
  ASSERT_TRUE(fleet.Report({"a", plan, ProgressOutcome::kReached}).ok());
  EXPECT_EQ(fleet.Records().at("a").live_trajectory, nullptr);
  EXPECT_FALSE(fleet.Records().at("a").live_goal.has_value());
  Plan stay = PlanTo("a", {1.0, 1.0});
  stay.chosen = -1;
  ASSERT_TRUE(fleet.Issue(stay, 0).ok());
  EXPECT_EQ(fleet.Records().at("a").live_trajectory, nullptr);
}

TEST(FleetRecords, TellHowFarAlongItsPlanARobotHasCome) {
  Fleet fleet = FleetOf({"a"});
  Plan there_and_back = PlanTo("a", {0.0, 0.0});
  there_and_back.trajectory.waypoints = {{{0, 0, 0}, 0.0}, {{5, 0, 0}, 5.0}, {{0, 0, 0}, 10.0}};
  const PlanId plan = *fleet.Issue(there_and_back, 0);
  for (const double time_s : {1.0, 3.0, 5.0, 6.5, 8.0}) {
    Observation observation = Numbered(1);
    observation.pose = PoseAt(there_and_back.trajectory, time_s);
    fleet.Advance("a", observation, false);
    EXPECT_NEAR(fleet.Records().at("a").live_gone_s, time_s, 1e-9);
  }
  ASSERT_TRUE(fleet.Report({"a", plan, ProgressOutcome::kReached}).ok());
  EXPECT_EQ(fleet.Records().at("a").live_gone_s, 0.0);
}

TEST(FleetPhase, IsCompleteWhenEveryRobotWasToldSo) {
  Fleet fleet = FleetOf({"a", "b"});
  Plan done = PlanTo("a", {1.0, 1.0});
  done.phase = MissionPhase::kComplete;
  done.chosen = -1;
  ASSERT_TRUE(fleet.Issue(PlanTo("b", {1.0, 1.0}), 0).ok());
  ASSERT_TRUE(fleet.Issue(done, 0).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kExploring);
  done.robot = "b";
  ASSERT_TRUE(fleet.Issue(done, 0).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kComplete);
}

TEST(FleetPhase, StaysCompleteWhenARobotIsSentHome) {
  Fleet fleet = FleetOf({"a"});
  Plan home = PlanTo("a", {1.0, 1.0}, GoalKind::kHome);
  home.phase = MissionPhase::kReturning;
  ASSERT_TRUE(fleet.Issue(home, 0).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kReturning);
  Plan done = home;
  done.phase = MissionPhase::kComplete;
  done.chosen = -1;
  ASSERT_TRUE(fleet.Issue(done, 0).ok());
  ASSERT_TRUE(fleet.Issue(home, 0).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kComplete);
  ASSERT_TRUE(fleet.Issue(PlanTo("a", {1.0, 1.0}), 0).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kExploring) << "there is something to do after all";
}

TEST(FleetMasks, CoverTheOtherRobotsWithPoses) {
  Fleet fleet = FleetOf({"a", "b", "c"});
  fleet.Advance("b", Numbered(1), false);
  ASSERT_EQ(fleet.MasksFor("a").size(), 1u);
  EXPECT_EQ(fleet.MasksFor("a")[0].center, (Point2{1.0, 2.0}));
  EXPECT_GT(fleet.MasksFor("a")[0].radius_m, 0.2);
  EXPECT_TRUE(fleet.MasksFor("b").empty());
}

TEST(FleetSilence, MaskClaimAndLivePlanLapseAndComeBackOnlyByANewPlan) {
  Fleet fleet(60.0);
  for (const char* robot : {"a", "b"}) {
    ASSERT_TRUE(fleet.Register({robot, 0.2, 1}, kMaxRobots).ok());
  }
  constexpr std::int64_t kStart_ns = 1'000'000 * kSecond_ns;
  fleet.Hear("b", kStart_ns);
  fleet.Advance("b", Numbered(1), false);
  const PlanId plan = *fleet.Issue(PlanTo("b", {1.0, 1.0}), kStart_ns);
  fleet.Hear("a", kStart_ns + 60 * kSecond_ns);
  EXPECT_EQ(fleet.MasksFor("a").size(), 1u);
  EXPECT_FALSE(fleet.Records().at("b").state.silent);

  fleet.Hear("a", kStart_ns + 60 * kSecond_ns + 1);
  EXPECT_TRUE(fleet.MasksFor("a").empty());
  EXPECT_TRUE(fleet.Records().at("b").state.silent);
  EXPECT_TRUE(fleet.Claims(kStart_ns).empty()) << "its claim would hold for 50 s";
  EXPECT_EQ(fleet.Records().at("b").live_trajectory, nullptr);

  fleet.Hear("b", kStart_ns + 61 * kSecond_ns);
  EXPECT_FALSE(fleet.Records().at("b").state.silent);
  EXPECT_EQ(fleet.MasksFor("a").size(), 1u);
  EXPECT_EQ(fleet.Report({"b", plan, ProgressOutcome::kReached}).status().code(),
            absl::StatusCode::kAlreadyExists);
}

TEST(FleetSilence, WhoIsAloneOrHasJustRegisteredIsNotSilent) {
  Fleet fleet(60.0);
  ASSERT_TRUE(fleet.Register({"a", 0.2, 1}, kMaxRobots).ok());
  ASSERT_TRUE(fleet.Register({"b", 0.2, 1}, kMaxRobots).ok());
  fleet.Hear("a", 1'000'000 * kSecond_ns);
  EXPECT_FALSE(fleet.Records().at("b").state.silent) << "no time has passed since it came";
  fleet.Hear("a", 1'000'100 * kSecond_ns);
  EXPECT_FALSE(fleet.Records().at("a").state.silent);
  EXPECT_TRUE(fleet.Records().at("b").state.silent);
  ASSERT_TRUE(fleet.Issue(PlanTo("b", {1.0, 1.0}), 1'000'100 * kSecond_ns).ok());
  EXPECT_FALSE(fleet.Records().at("b").state.silent) << "who asks for a plan is there";
}

TEST(FleetSilence, ADeadRobotKeepsNoMissionFromCompleting) {
  Fleet fleet(60.0);
  ASSERT_TRUE(fleet.Register({"a", 0.2, 1}, kMaxRobots).ok());
  ASSERT_TRUE(fleet.Register({"b", 0.2, 1}, kMaxRobots).ok());
  ASSERT_TRUE(fleet.Issue(PlanTo("b", {1.0, 1.0}), kSecond_ns).ok());
  Plan done = PlanTo("a", {1.0, 1.0});
  done.phase = MissionPhase::kComplete;
  done.chosen = -1;
  ASSERT_TRUE(fleet.Issue(done, kSecond_ns).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kExploring);
  fleet.Hear("a", 100 * kSecond_ns);
  EXPECT_EQ(fleet.Phase(), MissionPhase::kComplete);
  ASSERT_TRUE(fleet.Issue(PlanTo("b", {1.0, 1.0}), 100 * kSecond_ns).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kExploring) << "it lives";
}

TEST(FleetRemove, LeavesNothingButTheLogAndTheLease) {
  Fleet fleet = FleetOf({"a", "b", "c"});
  EXPECT_EQ(fleet.Remove("d").code(), absl::StatusCode::kNotFound);
  fleet.Advance("b", Numbered(1), false);
  ASSERT_TRUE(fleet.Issue(PlanTo("b", {1.0, 1.0}), 0).ok());
  Plan done = PlanTo("a", {1.0, 1.0});
  done.phase = MissionPhase::kComplete;
  done.chosen = -1;
  ASSERT_TRUE(fleet.Issue(done, 0).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kExploring);

  ASSERT_TRUE(fleet.Remove("b").ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kComplete);
  EXPECT_TRUE(fleet.MasksFor("a").empty());
  EXPECT_TRUE(fleet.Claims(0).empty());
  EXPECT_FALSE(fleet.Knows("b"));
  EXPECT_EQ(fleet.Records().count("b"), 0u);
  EXPECT_EQ(fleet.Remove("b").code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(fleet.CheckSequence("b", Numbered(2)).code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(fleet.AppliedSequence("b").status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(fleet.LeaseToken("b").status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(fleet.Issue(PlanTo("b", {1.0, 1.0}), 0).status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(fleet.Report({"b", 1, ProgressOutcome::kReached}).status().code(),
            absl::StatusCode::kNotFound);

  ASSERT_TRUE(fleet.Register({"d", 0.2, 1}, kMaxRobots).ok()) << "its place is free";
  EXPECT_EQ(fleet.Register({"b", 0.2, 2}, kMaxRobots).code(), absl::StatusCode::kResourceExhausted);
  ASSERT_TRUE(fleet.Remove("d").ok());
  EXPECT_EQ(fleet.Register({"b", 0.2, 1}, kMaxRobots).code(), absl::StatusCode::kFailedPrecondition)
      << "its lease was that old";
  ASSERT_TRUE(fleet.Register({"b", 0.2, 2}, kMaxRobots).ok());
  EXPECT_EQ(*fleet.AppliedSequence("b"), 1) << "no reading counts twice";
  EXPECT_TRUE(fleet.MasksFor("a").empty()) << "nobody knows where it is";
}

// To a site, where the last sample is taken after 10 s.
Plan PlanToSample(const RobotId& robot, Point2 position) {
  Plan plan = PlanTo(robot, position, GoalKind::kSite);
  plan.phase = MissionPhase::kSampling;
  return plan;
}

TEST(FleetNextMapUpdate, IsWhenTheFirstLivePlanHasItsLastSample) {
  Fleet fleet = FleetOf({"a", "b", "c"});
  EXPECT_FALSE(fleet.NextMapUpdate_ns(0).has_value());
  ASSERT_TRUE(fleet.Issue(PlanTo("c", {9.0, 1.0}), 0).ok());
  EXPECT_FALSE(fleet.NextMapUpdate_ns(0).has_value()) << "it samples no sites";
  const PlanId first = *fleet.Issue(PlanToSample("a", {1.0, 1.0}), 2 * kSecond_ns);
  ASSERT_TRUE(fleet.Issue(PlanToSample("b", {5.0, 1.0}), 4 * kSecond_ns).ok());
  EXPECT_EQ(fleet.NextMapUpdate_ns(4 * kSecond_ns), 12 * kSecond_ns);
  ASSERT_TRUE(fleet.Report({"a", first, ProgressOutcome::kReached}).ok());
  EXPECT_EQ(fleet.NextMapUpdate_ns(12 * kSecond_ns), 14 * kSecond_ns);
}

TEST(FleetNextMapUpdate, IsNowOfAPlanThatIsLateUntilItsClaimExpires) {
  Fleet fleet = FleetOf({"a"});
  ASSERT_TRUE(fleet.Issue(PlanToSample("a", {1.0, 1.0}), 0).ok());
  EXPECT_EQ(fleet.NextMapUpdate_ns(13 * kSecond_ns), 13 * kSecond_ns);
  EXPECT_FALSE(fleet.NextMapUpdate_ns(51 * kSecond_ns).has_value());  // 2 x 10 s + 30 s
}

TEST(FleetNextMapUpdate, IsNoneOfAPlanToStay) {
  Fleet fleet = FleetOf({"a"});
  Plan stay = PlanToSample("a", {1.0, 1.0});
  stay.chosen = -1;
  ASSERT_TRUE(fleet.Issue(stay, 0).ok());
  EXPECT_FALSE(fleet.NextMapUpdate_ns(0).has_value());
}

}  // namespace fleet_test
}  // namespace plumescout
