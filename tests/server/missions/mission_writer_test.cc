// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "absl/synchronization/notification.h"
#include "tests/core/mission/mission_peer.h"
#include "tests/server/host_parts.h"
#include "tests/support/same_bytes.h"

namespace plumescout::server {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kLease = 7;

class MissionWriterTest : public testing::Test {
 protected:
  MissionWriterTest() { EXPECT_TRUE(writer_.Register({"r1", 0.2, kLease}).ok()); }

  Plan PlanFor(const RobotId& robot, double x_m) { return PlanTo(*writer_.Snapshot(), robot, x_m); }

  std::vector<Event> events_;
  MissionWriter writer_{std::make_unique<Mission>(MissionOptions{}),
                        [this](const Event& event) { events_.push_back(event); }};
};

TEST_F(MissionWriterTest, BatchMovesTheLogToItsEnd) {
  const IngestResult result = writer_.Ingest("r1", kLease, GasBatch(1, 5));
  EXPECT_TRUE(result.status.ok());
  EXPECT_THAT(result.refused, IsEmpty());
  EXPECT_EQ(result.position.applied_sequence, 5);
  EXPECT_EQ(result.position.revision, 6);  // the registration and five readings
}

TEST_F(MissionWriterTest, RepeatsArePassedOver) {
  writer_.Ingest("r1", kLease, GasBatch(1, 5));
  const IngestResult result = writer_.Ingest("r1", kLease, GasBatch(3, 7));
  EXPECT_TRUE(result.status.ok());
  EXPECT_EQ(result.position.applied_sequence, 7);
  EXPECT_EQ(result.position.revision, 8);
}

TEST_F(MissionWriterTest, HoleStopsTheBatchAndNamesTheNumberExpected) {
  auto batch = GasBatch(1, 2);
  batch.push_back(GasBatch(4, 4)[0]);
  const IngestResult result = writer_.Ingest("r1", kLease, std::move(batch));
  EXPECT_TRUE(absl::IsFailedPrecondition(result.status));
  EXPECT_EQ(result.status.message().find("SEQUENCE_GAP: expected 3"), 0u);
  EXPECT_EQ(result.position.applied_sequence, 2);
}

TEST_F(MissionWriterTest, RefusedEntryCountsAsApplied) {
  auto batch = GasBatch(1, 3);
  batch[1].observation.pose.x_m = 1e9;
  const IngestResult result = writer_.Ingest("r1", kLease, std::move(batch));
  EXPECT_TRUE(result.status.ok());
  EXPECT_EQ(result.position.applied_sequence, 3);
  ASSERT_THAT(result.refused, SizeIs(1));
  EXPECT_EQ(result.refused[0].sequence, 2);
  EXPECT_TRUE(absl::IsInvalidArgument(result.refused[0].status));
}

TEST_F(MissionWriterTest, UnreadableEntryCountsAsRefusedForItsOwnReason) {
  auto batch = GasBatch(1, 3);
  batch[1].unreadable = absl::InvalidArgumentError("payload must be one of scan, gas, gap");
  const IngestResult result = writer_.Ingest("r1", kLease, std::move(batch));
  EXPECT_EQ(result.position.applied_sequence, 3);
  ASSERT_THAT(result.refused, SizeIs(1));
  EXPECT_EQ(result.refused[0].status.message(), "payload must be one of scan, gas, gap");
  EXPECT_EQ(writer_.Snapshot()->robots.at("r1").state.rejected_observations, 1);
}

TEST_F(MissionWriterTest, OldLeaseWritesNothing) {
  ASSERT_TRUE(writer_.Register({"r1", 0.2, kLease + 1}).ok());
  const std::int64_t revision = writer_.mission().revision();
  EXPECT_EQ(writer_.Ingest("r1", kLease, GasBatch(1, 1)).status.message().find("LEASE_SUPERSEDED"),
            0u);
  EXPECT_FALSE(writer_.Commit(PlanFor("r1", 1.0), kLease).ok());
  EXPECT_FALSE(writer_.Report({"r1", 1, ProgressOutcome::kReached}, kLease).ok());
  EXPECT_EQ(writer_.mission().revision(), revision);
}

TEST_F(MissionWriterTest, UnknownRobotIsNotFound) {
  EXPECT_TRUE(absl::IsNotFound(writer_.Ingest("r2", kLease, GasBatch(1, 1)).status));
  EXPECT_TRUE(absl::IsNotFound(writer_.Position("r2").status()));
}

TEST_F(MissionWriterTest, GoalClaimedByAnotherRobotAborts) {
  ASSERT_TRUE(writer_.Register({"r2", 0.2, kLease + 1}).ok());
  EXPECT_EQ(writer_.Commit(PlanFor("r1", 1.0), kLease).value(), 1);
  EXPECT_TRUE(absl::IsAborted(writer_.Commit(PlanFor("r2", 1.0), kLease + 1).status()));
  EXPECT_EQ(writer_.Commit(PlanFor("r2", 5.0), kLease + 1).value(), 2);
}

TEST_F(MissionWriterTest, RepeatedReportChangesNothing) {
  ASSERT_TRUE(writer_.Commit(PlanFor("r1", 1.0), kLease).ok());
  const auto first = writer_.Report({"r1", 1, ProgressOutcome::kReached}, kLease);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(writer_.Report({"r1", 1, ProgressOutcome::kReached}, kLease).value(), *first);
}

TEST_F(MissionWriterTest, FreshBeliefRefreshesOnceAndSnapshotNever) {
  writer_.Ingest("r1", kLease, GasBatch(1, 1));
  const std::int64_t revision = writer_.mission().revision();
  EXPECT_EQ(writer_.Snapshot()->revision, revision);
  EXPECT_EQ(writer_.FreshBelief().value()->revision, revision + 1);
  EXPECT_EQ(writer_.FreshBelief().value()->revision, revision + 1);
}

TEST_F(MissionWriterTest, SummaryIsNeverBehindAnEvent) {
  EXPECT_EQ(writer_.summary().revision, 1);
  EXPECT_EQ(writer_.summary().phase, MissionPhase::kExploring);
  Plan plan = PlanFor("r1", 1.0);
  plan.phase = MissionPhase::kGasProbing;
  ASSERT_TRUE(writer_.Commit(plan, kLease).ok());
  EXPECT_EQ(writer_.summary().revision, 2);
  EXPECT_EQ(writer_.summary().phase, MissionPhase::kGasProbing);
}

TEST_F(MissionWriterTest, EventsToldRebuildTheSameMission) {
  writer_.Ingest("r1", kLease, GasBatch(1, 3));
  ASSERT_TRUE(writer_.FreshBelief().ok());
  ASSERT_TRUE(writer_.Commit(PlanFor("r1", 1.0), kLease).ok());
  Mission replayed{MissionOptions{}};
  for (std::size_t i = 0; i < events_.size(); ++i) {
    EXPECT_EQ(events_[i].number, static_cast<std::int64_t>(i) + 1);
    ASSERT_TRUE(replayed.Apply(events_[i].body).ok());
  }
  EXPECT_EQ(replayed.revision(), writer_.mission().revision());
  EXPECT_EQ(replayed.Snapshot()->claims.size(), 1u);
}

void ExpectSame(const Belief& a, const Belief& b) {
  EXPECT_EQ(a.revision, b.revision);
  EXPECT_EQ(*a.occupancy, *b.occupancy);
  EXPECT_TRUE(support::SameBytes(*a.gas_mean_ppm, *b.gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*a.gas_variance_ppm2, *b.gas_variance_ppm2));
  EXPECT_EQ(a.gas_quality, b.gas_quality);
}

struct Recording {
  std::vector<Event> events;
  std::shared_ptr<const Belief> belief;
};

Recording Record(WorkerPool* epoch_pool) {
  Recording recording;
  MissionWriter writer(
      std::make_unique<Mission>(support::FastAgeing()),
      [&](const Event& event) { recording.events.push_back(event); }, epoch_pool);
  EXPECT_TRUE(writer.Register({"r1", 0.2, kLease}).ok());
  const IngestResult result = writer.Ingest("r1", kLease, RoomRunBatch());
  EXPECT_TRUE(result.status.ok()) << result.status;
  EXPECT_THAT(result.refused, IsEmpty());
  recording.belief = writer.Snapshot();
  return recording;
}

TEST(MissionWriterEpochs, ReplayOfTheEventsComesToTheSameBytes) {
  WorkerPool pool({"epoch", 1, 1});
  const Recording recording = Record(&pool);
  EXPECT_GE(recording.belief->gas_quality.epochs, 1);
  Mission replayed(support::FastAgeing());
  for (const Event& event : recording.events) ASSERT_TRUE(replayed.Apply(event.body).ok());
  ExpectSame(*replayed.Snapshot(), *recording.belief);
}

TEST(MissionWriterEpochs, EventsAndBytesAreTheSameWhoeverRecomputes) {
  WorkerPool pool({"epoch", 1, 1});
  const Recording beside = Record(&pool);
  absl::Notification release;
  Recording refused;
  {
    WorkerPool busy({"epoch", 1, 1});
    ASSERT_TRUE(busy.Submit([&] { release.WaitForNotification(); }).ok());
    refused = Record(&busy);
    release.Notify();
  }
  const Recording alone = Record(nullptr);
  EXPECT_EQ(beside.events, alone.events);
  EXPECT_EQ(refused.events, alone.events);
  ExpectSame(*beside.belief, *alone.belief);
  ExpectSame(*refused.belief, *alone.belief);
}

TEST(MissionWriterEpochs, EventsDoNotDependOnHowTheLogWasCut) {
  const Recording whole = Record(nullptr);
  std::vector<Event> events;
  MissionWriter writer(std::make_unique<Mission>(support::FastAgeing()),
                       [&](const Event& event) { events.push_back(event); });
  ASSERT_TRUE(writer.Register({"r1", 0.2, kLease}).ok());
  for (IncomingObservation& incoming : RoomRunBatch()) {
    std::vector<IncomingObservation> batch;
    batch.push_back(std::move(incoming));
    ASSERT_TRUE(writer.Ingest("r1", kLease, std::move(batch)).status.ok());
  }
  EXPECT_EQ(events, whole.events);
}

TEST(MissionWriterEpochs, EventsOfOneObservationComeInTheirOrder) {
  const Recording recording = Record(nullptr);
  // Within the events between two observations the kinds come in this order, once each at most.
  const auto rank = [](const EventBody& body) {
    if (std::holds_alternative<EpochAdopted>(body)) return 1;
    if (std::holds_alternative<PosteriorRefreshed>(body)) return 2;
    return std::holds_alternative<EpochBegun>(body) ? 3 : 0;
  };
  for (std::size_t i = 1; i < recording.events.size(); ++i) {
    const int here = rank(recording.events[i].body);
    EXPECT_TRUE(here == 0 || rank(recording.events[i - 1].body) < here) << "event " << i + 1;
  }
}

TEST(MissionWriterGas, PublicationRefreshesOnlyForAReadingThatHasWaited) {
  SteadyTime now;
  MissionWriter writer(std::make_unique<Mission>(MissionOptions{}), nullptr, nullptr,
                       [&now] { return now; });
  ASSERT_TRUE(writer.Register({"r1", 0.2, kLease}).ok());
  ASSERT_TRUE(writer.Ingest("r1", kLease, GasBatch(1, 1)).status.ok());
  const absl::Duration wait = absl::Milliseconds(80);
  now += std::chrono::milliseconds(79);
  EXPECT_EQ(writer.Publish(wait)->posterior_time_ns, 0);
  now += std::chrono::milliseconds(1);
  const auto belief = writer.Publish(wait);
  EXPECT_EQ(belief->posterior_time_ns, belief->sample_time_ns);
  EXPECT_EQ(writer.gas_timings().staleness.samples, 1);
  EXPECT_EQ(writer.gas_timings().staleness.max, wait);
  EXPECT_EQ(writer.gas_timings().update.samples, 1);
  EXPECT_EQ(writer.unpublished_since(), SteadyTime::max());
}

TEST(MissionWriterGas, FieldThatCannotBeComputedIsToldAndRecorded) {
  const auto broken = [] {
    auto mission = std::make_unique<Mission>(support::FastAgeing());
    GasMapPeer::LosePrior(MissionPeer::Gas(*mission));
    return mission;
  };
  std::vector<Event> events;
  MissionWriter writer(broken(), [&](const Event& event) { events.push_back(event); });
  ASSERT_TRUE(writer.Register({"r1", 0.2, kLease}).ok());
  if (GasMapPeer::kStopsAtDefects) {
    EXPECT_DEATH(writer.Ingest("r1", kLease, RoomRunBatch()), GasMapPeer::kDefect);
    return;
  }
  ASSERT_TRUE(writer.Ingest("r1", kLease, RoomRunBatch()).status.ok());
  EXPECT_EQ(writer.FreshBelief().status().code(), absl::StatusCode::kInternal);
  const auto belief = writer.Snapshot();
  EXPECT_GT(belief->gas_quality.failures, 1);
  EXPECT_TRUE(std::holds_alternative<PosteriorRefreshed>(events.back().body));

  const auto replayed = broken();
  for (const Event& event : events) ASSERT_TRUE(replayed->Apply(event.body).ok());
  ExpectSame(*replayed->Snapshot(), *belief);
}

TEST(MissionWriterGas, RefusedReadingsAreNotWaitedFor) {
  MissionWriter writer(std::make_unique<Mission>(MissionOptions{}), nullptr);
  ASSERT_TRUE(writer.Register({"r1", 0.2, kLease}).ok());
  auto batch = GasBatch(1, 1);
  batch[0].observation.pose.x_m = 1e9;
  writer.Ingest("r1", kLease, std::move(batch));
  EXPECT_EQ(writer.unpublished_since(), SteadyTime::max());
}

}  // namespace
}  // namespace plumescout::server
