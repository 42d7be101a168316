// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What becomes of commands; the gas posterior has mission_conduct_gas_test.cc.
#include "core/mission/conduct/mission_conduct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "core/types/error_reason.h"
#include "tests/support/box_room.h"
#include "tests/support/ingest_batch.h"
#include "tests/support/scripted_strategy.h"

namespace plumescout {
namespace mission_conduct_test {

using support::GasBatch;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kLease = 7;

class MissionConductTest : public testing::Test, private ConductObserver {
 protected:
  MissionConductTest() { EXPECT_TRUE(Join("r1", kLease).ok()); }

  absl::StatusOr<LogPosition> Join(const RobotId& robot, std::int64_t lease_token) {
    return conduct_.Register(RobotRegistered{robot, 0.2, lease_token});
  }
  Plan PlanFor(const RobotId& robot, double x_m) {
    return support::PlanTo(*conduct_.Snapshot(), robot, x_m);
  }
  std::int64_t revision() const { return conduct_.mission().revision(); }

  std::vector<Event> events_;
  MissionConduct conduct_{std::make_unique<Mission>(MissionOptions{}), this};

 private:
  void OnEvent(const Event& event, const Applied& applied) override {
    EXPECT_EQ(applied.revision, event.number);
    EXPECT_EQ(conduct_.mission().revision(), event.number);
    events_.push_back(event);
  }
};

TEST_F(MissionConductTest, BatchMovesTheLogToItsEnd) {
  const IngestResult result = conduct_.Ingest("r1", kLease, GasBatch(1, 5));
  EXPECT_TRUE(result.status.ok());
  EXPECT_THAT(result.refused, IsEmpty());
  EXPECT_EQ(result.position.applied_sequence, 5);
  EXPECT_EQ(result.position.revision, 6);  // the registration and five readings
}

TEST_F(MissionConductTest, RepeatsArePassedOver) {
  conduct_.Ingest("r1", kLease, GasBatch(1, 5));
  const IngestResult result = conduct_.Ingest("r1", kLease, GasBatch(3, 7));
  EXPECT_TRUE(result.status.ok());
  EXPECT_THAT(result.refused, IsEmpty());
  EXPECT_EQ(result.position.applied_sequence, 7);
  EXPECT_EQ(result.position.revision, 8);
}

TEST_F(MissionConductTest, HoleStopsTheBatchAndNamesTheNumberExpected) {
  auto batch = GasBatch(1, 2);
  for (IncomingObservation& later : GasBatch(4, 5)) batch.push_back(std::move(later));
  const IngestResult result = conduct_.Ingest("r1", kLease, std::move(batch));
  EXPECT_TRUE(absl::IsFailedPrecondition(result.status));
  EXPECT_EQ(result.status.message().find("SEQUENCE_GAP: expected 3"), 0U);
  EXPECT_EQ(result.position.applied_sequence, 2);
}

TEST_F(MissionConductTest, DeclaredGapIsNoHole) {
  auto batch = GasBatch(1, 2);
  batch[1].observation.payload = SequenceGap{2, 9};
  batch.push_back(GasBatch(10, 10)[0]);
  const IngestResult result = conduct_.Ingest("r1", kLease, std::move(batch));
  EXPECT_TRUE(result.status.ok()) << result.status;
  EXPECT_EQ(result.position.applied_sequence, 10);
}

TEST_F(MissionConductTest, RefusedEntryCountsAsApplied) {
  auto batch = GasBatch(1, 3);
  batch[1].observation.pose.x_m = 1e9;
  const IngestResult result = conduct_.Ingest("r1", kLease, std::move(batch));
  EXPECT_TRUE(result.status.ok());
  EXPECT_EQ(result.position.applied_sequence, 3);
  ASSERT_THAT(result.refused, SizeIs(1));
  EXPECT_EQ(result.refused[0].sequence, 2);
  EXPECT_TRUE(absl::IsInvalidArgument(result.refused[0].status));
}

TEST_F(MissionConductTest, UnreadableEntryCountsAsRefusedForItsOwnReason) {
  auto batch = GasBatch(1, 3);
  batch[1].unreadable = absl::InvalidArgumentError("payload must be one of scan, gas, gap");
  const IngestResult result = conduct_.Ingest("r1", kLease, std::move(batch));
  EXPECT_EQ(result.position.applied_sequence, 3);
  ASSERT_THAT(result.refused, SizeIs(1));
  EXPECT_EQ(result.refused[0].status.message(), "payload must be one of scan, gas, gap");
  EXPECT_EQ(conduct_.Snapshot()->robots.at("r1").state.rejected_observations, 1);
  const auto& told = std::get<ObservationReceived>(events_[2].body);
  EXPECT_EQ(told.observation,
            (Observation{.sequence = 2, .sample_time_ns = 0, .pose = {}, .payload = Scan{}}));
}

TEST_F(MissionConductTest, RegistrationPutsALeaseInForce) {
  LeaseBook book(/*hold_ns=*/1000, /*first_token=*/50);
  LeasesAt leases(book, /*now_ns=*/0);
  const auto registered = conduct_.Register(Registration{"r2", 0.2, false}, leases);
  ASSERT_TRUE(registered.ok()) << registered.status();
  EXPECT_EQ(registered->lease_token, 50);
  EXPECT_EQ(registered->position.revision, 2);
  EXPECT_TRUE(book.Check("r2", 50).ok());
  EXPECT_TRUE(conduct_.CheckLease("r2", 50).ok());
  EXPECT_EQ(events_.back().body, EventBody(RobotRegistered{"r2", 0.2, 50}));
}

TEST_F(MissionConductTest, RegistrationSaysWhetherTheLogGoesOn) {
  LeaseBook book(/*hold_ns=*/1000, /*first_token=*/50);
  LeasesAt leases(book, /*now_ns=*/0);
  const auto join = [&](std::int64_t log_epoch) {
    return *conduct_.Register(Registration{"r2", 0.2, /*take_over=*/true, log_epoch}, leases);
  };
  const Registered first = join(8);
  EXPECT_TRUE(first.log_continues);
  EXPECT_EQ(events_.back().body, EventBody(RobotRegistered{"r2", 0.2, 50, 8}));
  ASSERT_TRUE(conduct_.Ingest("r2", first.lease_token, GasBatch(1, 3)).status.ok());
  EXPECT_TRUE(join(8).log_continues);
  EXPECT_TRUE(join(0).log_continues);
  const Registered other = join(9);
  EXPECT_FALSE(other.log_continues);
  EXPECT_EQ(other.position.applied_sequence, 3);
  EXPECT_TRUE(absl::IsInvalidArgument(
      conduct_.Register(Registration{"r2", 0.2, true, -1}, leases).status()));
}

TEST_F(MissionConductTest, RegistrationUnderALeaseThatIsHeldIsNoEvent) {
  LeaseBook book(/*hold_ns=*/1000, /*first_token=*/50);
  LeasesAt leases(book, /*now_ns=*/0);
  ASSERT_TRUE(conduct_.Register(Registration{"r2", 0.2, false}, leases).ok());
  const auto refused = conduct_.Register(Registration{"r2", 0.2, false}, leases);
  EXPECT_EQ(ErrorReason(refused.status()), reason::kLeaseHeld);
  EXPECT_EQ(revision(), 2);
  const auto taken = conduct_.Register(Registration{"r2", 0.2, /*take_over=*/true}, leases);
  ASSERT_TRUE(taken.ok());
  EXPECT_EQ(ErrorReason(book.Check("r2", 50)), reason::kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(conduct_.CheckLease("r2", 50)), reason::kLeaseSuperseded);
}

TEST_F(MissionConductTest, RegistrationThatTheMissionRefusesLeavesTheLeaseAlone) {
  LeaseBook book(/*hold_ns=*/1000, /*first_token=*/50);
  LeasesAt leases(book, /*now_ns=*/0);
  const auto held = conduct_.Register(Registration{"r2", 0.2, false}, leases);
  ASSERT_TRUE(held.ok());
  EXPECT_TRUE(absl::IsInvalidArgument(
      conduct_.Register(Registration{"r2", -1.0, /*take_over=*/true}, leases).status()));
  EXPECT_TRUE(book.Check("r2", held->lease_token).ok());
  EXPECT_EQ(revision(), 2);
}

TEST_F(MissionConductTest, OldLeaseWritesNothing) {
  ASSERT_TRUE(Join("r1", kLease + 1).ok());
  const std::int64_t before = revision();
  const IngestResult ingested = conduct_.Ingest("r1", kLease, GasBatch(1, 1));
  EXPECT_EQ(ErrorReason(ingested.status), reason::kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(conduct_.Commit(PlanFor("r1", 1.0), kLease).status()),
            reason::kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(conduct_.Report({"r1", 1, ProgressOutcome::kReached}, kLease).status()),
            reason::kLeaseSuperseded);
  EXPECT_EQ(revision(), before);
}

TEST_F(MissionConductTest, UnknownRobotIsNotFound) {
  EXPECT_EQ(ErrorReason(conduct_.Ingest("r2", kLease, GasBatch(1, 1)).status),
            reason::kRobotNotFound);
  EXPECT_EQ(ErrorReason(conduct_.Position("r2").status()), reason::kRobotNotFound);
  EXPECT_EQ(ErrorReason(conduct_.CheckLease("r2", kLease)), reason::kRobotNotFound);
}

TEST_F(MissionConductTest, GoalClaimedByAnotherRobotAborts) {
  ASSERT_TRUE(Join("r2", kLease + 1).ok());
  EXPECT_EQ(conduct_.Commit(PlanFor("r1", 1.0), kLease).value(), 1);
  EXPECT_TRUE(absl::IsAborted(conduct_.Commit(PlanFor("r2", 1.0), kLease + 1).status()));
  Plan for_something_else = PlanFor("r2", 1.0);
  for_something_else.candidates[0].goal.kind = GoalKind::kInformation;
  EXPECT_TRUE(absl::IsAborted(conduct_.Commit(for_something_else, kLease + 1).status()));
  EXPECT_EQ(conduct_.Commit(PlanFor("r2", 5.0), kLease + 1).value(), 2);
}

TEST_F(MissionConductTest, AWayThatMeetsOneThatWasGivenMeanwhileAborts) {
  ASSERT_TRUE(Join("r2", kLease + 1).ok());
  conduct_.Ingest("r1", kLease, GasBatch(1, 1));
  conduct_.Ingest("r2", kLease + 1, GasBatch(1, 1, {4.0, 0.0, 0.0}));
  const auto drive = [&](const RobotId& robot, Point2 from, Point2 to) {
    Plan plan = PlanFor(robot, to.x_m);
    plan.trajectory.waypoints = {{{from.x_m, from.y_m, 0.0}, 0.0}, {{to.x_m, to.y_m, 0.0}, 4.0}};
    plan.trajectory.duration_s = 4.0;
    return plan;
  };
  const Plan east = drive("r1", {0.0, 0.0}, {3.0, 3.0});
  const Plan north = drive("r2", {4.0, 0.0}, {2.9, 2.8});
  EXPECT_TRUE(conduct_.Commit(east, kLease).ok());
  const absl::Status status = conduct_.Commit(north, kLease + 1).status();
  EXPECT_TRUE(absl::IsAborted(status));
  EXPECT_THAT(std::string(status.message()), ::testing::HasSubstr("meets robot \"r1\""));
  EXPECT_TRUE(conduct_.Commit(drive("r2", {4.0, 0.0}, {4.0, -3.0}), kLease + 1).ok());
}

TEST_F(MissionConductTest, RepeatedReportChangesNothing) {
  ASSERT_TRUE(conduct_.Commit(PlanFor("r1", 1.0), kLease).ok());
  const auto first = conduct_.Report({"r1", 1, ProgressOutcome::kReached}, kLease);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(*first, revision());
  EXPECT_EQ(conduct_.Report({"r1", 1, ProgressOutcome::kReached}, kLease).value(), *first);
  EXPECT_TRUE(
      absl::IsNotFound(conduct_.Report({"r1", 9, ProgressOutcome::kReached}, kLease).status()));
}

TEST_F(MissionConductTest, WishForABeliefWaitsForItsRobotsLog) {
  const BeliefWish wish{.robot = "r1", .min_applied_sequence = 3, .lease_token = kLease};
  conduct_.Ingest("r1", kLease, GasBatch(1, 2));
  EXPECT_FALSE(conduct_.Verdict(wish).has_value());
  EXPECT_EQ(
      conduct_.WaitedInVain(wish),
      absl::DeadlineExceededError("waited for sequence 3 of robot \"r1\", which stands at 2"));
  conduct_.Ingest("r1", kLease, GasBatch(3, 3));
  EXPECT_EQ(conduct_.Verdict(wish), absl::OkStatus());
  EXPECT_EQ(conduct_.BeliefFor(wish).value()->robots.at("r1").state.applied_sequence, 3);
}

TEST_F(MissionConductTest, WishForABeliefEndsWithItsLease) {
  const BeliefWish wish{.robot = "r1", .min_applied_sequence = 3, .lease_token = kLease};
  ASSERT_TRUE(Join("r1", kLease + 1).ok());
  EXPECT_EQ(ErrorReason(conduct_.Verdict(wish).value()), reason::kLeaseSuperseded);
  conduct_.Ingest("r1", kLease + 1, GasBatch(1, 3));  // by the successor
  EXPECT_EQ(ErrorReason(conduct_.Verdict(wish).value()), reason::kLeaseSuperseded);
}

TEST_F(MissionConductTest, WishForABeliefWithoutALeaseIsAnybodys) {
  EXPECT_EQ(conduct_.Verdict({}), absl::OkStatus());
  EXPECT_EQ(conduct_.Verdict({.robot = "r1"}), absl::OkStatus());
  EXPECT_FALSE(conduct_.Verdict({.robot = "r1", .min_applied_sequence = 1}).has_value());
  EXPECT_EQ(ErrorReason(conduct_.Verdict({.robot = "r9"}).value()), reason::kRobotNotFound);
}

TEST_F(MissionConductTest, EventsToldRebuildTheSameMission) {
  conduct_.Ingest("r1", kLease, GasBatch(1, 3));
  ASSERT_TRUE(conduct_.FreshBelief().ok());
  ASSERT_TRUE(conduct_.Commit(PlanFor("r1", 1.0), kLease).ok());
  Mission replayed{MissionOptions{}};
  for (std::size_t i = 0; i < events_.size(); ++i) {
    EXPECT_EQ(events_[i].number, static_cast<std::int64_t>(i) + 1);
    ASSERT_TRUE(replayed.Apply(events_[i].body).ok());
  }
  EXPECT_EQ(replayed.revision(), revision());
  EXPECT_EQ(replayed.Snapshot()->claims.size(), 1U);
}

TEST_F(MissionConductTest, CommandsThatChangeNothingAreNotTold) {
  conduct_.Ingest("r1", kLease, GasBatch(2, 2));
  EXPECT_FALSE(conduct_.Commit(PlanFor("r2", 1.0), kLease).ok());
  EXPECT_FALSE(conduct_.BeginEpoch().ok());
  conduct_.Snapshot();
  EXPECT_THAT(events_, SizeIs(1));
}

TEST_F(MissionConductTest, ARobotLeavesByItsOwnLeaseOrByForce) {
  LeaseBook book(/*hold_ns=*/1000, /*first_token=*/100);
  LeasesAt leases(book, 0);
  const auto joined = conduct_.Register({"r2", 0.2, false}, leases);
  ASSERT_TRUE(joined.ok()) << joined.status();
  const std::size_t events = events_.size();
  EXPECT_EQ(ErrorReason(conduct_.Remove({"r2", joined->lease_token - 1}, leases).status()),
            reason::kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(conduct_.Remove({"r3", 1}, leases).status()), reason::kRobotNotFound);
  EXPECT_EQ(ErrorReason(conduct_.Remove({"r3"}, leases).status()), reason::kRobotNotFound);
  EXPECT_EQ(events_.size(), events);
  EXPECT_EQ(book.robot_count(), 1);

  const auto removed = conduct_.Remove({"r2", joined->lease_token}, leases);
  ASSERT_TRUE(removed.ok()) << removed.status();
  EXPECT_EQ(*removed, revision());
  EXPECT_EQ(events_.back().body, EventBody(RobotRemoved{"r2"}));
  EXPECT_EQ(book.robot_count(), 0);
  EXPECT_EQ(ErrorReason(conduct_.Ingest("r2", joined->lease_token, GasBatch(1, 1)).status),
            reason::kRobotNotFound);

  ASSERT_TRUE(conduct_.Register({"r2", 0.2, false}, leases).ok());
  EXPECT_TRUE(conduct_.Remove({"r2"}, leases).ok());
}

TEST_F(MissionConductTest, AnOffsetIsNotedUnderTheLeaseAndOnce) {
  EXPECT_TRUE(conduct_.NoteClock({"r1", 5}, kLease).ok());
  EXPECT_TRUE(conduct_.NoteClock({"r1", 5}, kLease).ok());
  EXPECT_EQ(revision(), 2);
  EXPECT_EQ(conduct_.mission().StateOf("r1")->clock_offset_ns, 5);
  EXPECT_EQ(ErrorReason(conduct_.NoteClock({"r1", 6}, kLease - 1)), reason::kLeaseSuperseded);
  EXPECT_EQ(ErrorReason(conduct_.NoteClock({"r9", 6}, kLease)), reason::kRobotNotFound);
  EXPECT_TRUE(absl::IsInvalidArgument(conduct_.NoteClock({"r1", INT64_MAX}, kLease)));
  EXPECT_EQ(revision(), 2);
}

TEST_F(MissionConductTest, HomeIsOrderedOfAllOrNone) {
  ASSERT_TRUE(Join("r2", kLease + 1).ok());
  EXPECT_EQ(ErrorReason(conduct_.OrderHome({"r1", "r9"}, true).status()), reason::kRobotNotFound);
  EXPECT_EQ(revision(), 2);
  EXPECT_EQ(conduct_.OrderHome({"r1"}, true).value(), 3);
  EXPECT_EQ(conduct_.OrderHome({"r1", "r2"}, true).value(), 4) << "r1 knows";
  EXPECT_EQ(conduct_.OrderHome({"r1", "r2"}, true).value(), 4);
  EXPECT_EQ(conduct_.OrderHome({"r1", "r2"}, false).value(), 6);
  EXPECT_FALSE(conduct_.mission().StateOf("r1")->ordered_home);
}

TEST_F(MissionConductTest, AreasChangeByOneEventOrNone) {
  EXPECT_EQ(conduct_.ChangeKeepOut({}).value(), 1);
  EXPECT_EQ(events_.size(), 1u);
  const Polygon spill{{{5.0, 5.0}, {6.0, 5.0}, {6.0, 6.0}}, "spill"};
  EXPECT_EQ(conduct_.ChangeKeepOut({{}, {spill}}).value(), 2);
  EXPECT_EQ(conduct_.mission().options().keep_out, std::vector<Polygon>{spill});
  EXPECT_EQ(ErrorReason(conduct_.ChangeKeepOut({{}, {spill}}).status()),
            reason::kKeepOutAreaExists);
  EXPECT_EQ(revision(), 2);
}

TEST_F(MissionConductTest, AWayThroughAnAreaThatWasJustClosedIsSearchedForAgain) {
  const Pose2 pose{1.0, 1.5, 0.0};
  for (std::int64_t sequence = 1; sequence <= 3; ++sequence) {
    const Scan scan = support::ScanInBox(pose, 4.0, 3.0);
    const Observation seen{sequence, sequence * 1'000'000'000, pose, scan};
    ASSERT_TRUE(conduct_.Ingest("r1", kLease, {{seen, absl::OkStatus()}}).refused.empty());
  }
  Plan plan = PlanFor("r1", 3.5);
  plan.trajectory.waypoints = {{pose}, {{3.5, 1.5, 0.0}}};
  const Polygon spill{{{2.0, 1.0}, {3.0, 1.0}, {3.0, 2.0}, {2.0, 2.0}}, "spill"};
  ASSERT_TRUE(conduct_.ChangeKeepOut({{}, {spill}}).ok());
  EXPECT_TRUE(absl::IsAborted(conduct_.Commit(plan, kLease).status()));
  plan.belief_revision = revision();
  EXPECT_TRUE(conduct_.Commit(plan, kLease).ok()) << "whoever planned on it kept out";
}

}  // namespace mission_conduct_test
}  // namespace plumescout
