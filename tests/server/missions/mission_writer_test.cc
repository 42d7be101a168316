// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/synchronization/notification.h"
#include "tests/core/mission/mission_peer.h"
#include "tests/server/captured_log.h"
#include "tests/server/host_parts.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout::server {
namespace mission_writer_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kLease = 7;

TEST(MissionWriterTest, SummaryIsNeverBehindAnEvent) {
  MissionWriter* teller = nullptr;
  std::vector<std::int64_t> numbers;
  MissionWriter writer(std::make_unique<Mission>(MissionOptions{}),
                       [&](const Event& event, const Applied&) {
                         numbers.push_back(event.number);
                         EXPECT_EQ(teller->summary().revision, event.number - 1);
                       });
  teller = &writer;
  ASSERT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
  EXPECT_EQ(writer.summary().revision, 1);
  EXPECT_EQ(writer.summary().phase, MissionPhase::kExploring);
  Plan plan = PlanTo(*writer.conduct().Snapshot(), "r1", 1.0);
  plan.phase = MissionPhase::kGasProbing;
  ASSERT_TRUE(writer.conduct().Commit(plan, kLease).ok());
  EXPECT_EQ(writer.summary().revision, 2);
  EXPECT_EQ(writer.summary().phase, MissionPhase::kGasProbing);
  EXPECT_THAT(numbers, ElementsAre(1, 2));
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
      [&](const Event& event, const Applied&) { recording.events.push_back(event); }, epoch_pool);
  EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
  const IngestResult result = writer.conduct().Ingest("r1", kLease, RoomRunBatch());
  EXPECT_TRUE(result.status.ok()) << result.status;
  EXPECT_THAT(result.refused, IsEmpty());
  recording.belief = writer.conduct().Snapshot();
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

TEST(MissionWriterMap, ARebuiltMapThatIsNotTakenIsLogged) {
  constexpr std::int64_t kStep_ns = 100'000'000;
  MissionOptions options;
  options.occupancy.max_extent_m = 20.0;
  MissionWriter writer(std::make_unique<Mission>(options), nullptr);
  ASSERT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
  std::int64_t sequence = 0;
  const auto send = [&](const Pose2& pose, ObservationPayload payload) {
    ++sequence;
    std::vector<IncomingObservation> batch(1);
    batch[0].observation = {sequence, (9 + sequence) * kStep_ns, pose, std::move(payload)};
    const IngestResult result = writer.conduct().Ingest("r1", kLease, std::move(batch));
    EXPECT_TRUE(result.status.ok() && result.refused.empty()) << sequence;
  };
  const Pose2 held{3.5, 2.5, 0.0};
  const Pose2 right{16.3, 2.5, 0.0};  // the room there and here is wider than the map may be
  const std::string log = LogOf([&] {
    for (int i = 0; i < 10; ++i) send(held, support::ScanInBox(held, 7.0, 5.0));
    send(right, PoseCorrection{{{10 * kStep_ns, right}}});
    for (int i = 0; i < 70; ++i) send(right, GasReading{1.0, 0.0});
  });
  EXPECT_THAT(log, HasSubstr("not taken: the old one stays"));
  EXPECT_THAT(log, HasSubstr("max_extent_m"));
}

TEST(MissionWriterAudit, FindsCountsAndMendsAFieldThatWasMisled) {
  for (const bool misled : {false, true}) {
    std::optional<WorkerPool> pool(std::in_place, WorkerPoolOptions{"audit", 1, 1});
    auto mission = std::make_unique<Mission>(support::FastAgeing());
    GasMap& gas = MissionPeer::Gas(*mission);
    std::vector<Event> events;
    bool struck = false;
    MissionWriter writer(
        std::move(mission),
        [&](const Event& event, const Applied&) {
          events.push_back(event);
          // As the epoch takes its place, and before it is audited.
          if (!misled || struck || !std::holds_alternative<EpochAdopted>(event.body)) return;
          struck = true;
          const auto moment = gas.MakeAudit();
          std::size_t index = 0;
          while (std::isnan(moment->mean_ppm[index])) ++index;
          GasMapPeer::Mislead(gas, moment->lattice.CellAt(index), 50.0);
        },
        nullptr, SteadyNow, &*pool);
    ASSERT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
    auto log = RoomRunBatch();
    std::size_t next = 0;
    while (writer.mission().Snapshot()->gas_quality.epochs == 0 && next < log.size()) {
      ASSERT_TRUE(writer.conduct().Ingest("r1", kLease, {log[next++]}).status.ok());
    }
    pool.reset();  // the audit has ended; the next one is 30 epochs away
    writer.CollectAudit();
    const GasAudits audits = writer.conduct().Snapshot()->gas_audits;
    EXPECT_EQ(audits.audits, 1);
    EXPECT_EQ(audits.alarms, misled ? 1 : 0);
    EXPECT_EQ(audits.mean_ppm > 1e-3, misled);
    EXPECT_NE(writer.mission().epoch(), nullptr) << "under way to mend it, or by its time";
    while (writer.mission().Snapshot()->gas_quality.epochs == 1 && next < log.size()) {
      ASSERT_TRUE(writer.conduct().Ingest("r1", kLease, {log[next++]}).status.ok());
    }
    EXPECT_EQ(writer.mission().Snapshot()->gas_quality.epochs, 2);
    Mission replayed(support::FastAgeing());
    for (const Event& event : events) ASSERT_TRUE(replayed.Apply(event.body).ok());
    const auto a = writer.conduct().Snapshot();
    const auto b = replayed.Snapshot();
    EXPECT_TRUE(support::SameBytes(*a->gas_mean_ppm, *b->gas_mean_ppm)) << "as if not misled";
    EXPECT_TRUE(support::SameBytes(*a->gas_variance_ppm2, *b->gas_variance_ppm2));
  }
}

TEST(MissionWriterGas, PublicationRefreshesOnlyForAReadingThatHasWaited) {
  SteadyTime now;
  MissionWriter writer(std::make_unique<Mission>(MissionOptions{}), nullptr, nullptr,
                       [&now] { return now; });
  ASSERT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
  ASSERT_TRUE(writer.conduct().Ingest("r1", kLease, GasBatch(1, 1)).status.ok());
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

TEST(MissionWriterGas, FieldThatCannotBeComputedIsTriedAgainLater) {
  SteadyTime now;
  auto mission = std::make_unique<Mission>(support::FastAgeing());
  GasMapPeer::LosePrior(MissionPeer::Gas(*mission));
  MissionWriter writer(std::move(mission), nullptr, nullptr, [&now] { return now; });
  ASSERT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
  if (GasMapPeer::kStopsAtDefects) {
    EXPECT_DEATH(writer.conduct().Ingest("r1", kLease, RoomRunBatch()), GasMapPeer::kDefect);
    return;
  }
  ASSERT_TRUE(writer.conduct().Ingest("r1", kLease, RoomRunBatch()).status.ok());
  writer.Publish(absl::Hours(1));  // what the field held before there was anything to compute
  const std::int64_t updates = writer.gas_timings().update.samples;
  const std::int64_t failures = writer.conduct().Snapshot()->gas_quality.failures;
  ASSERT_EQ(writer.unpublished_since(), SteadyTime());
  now += std::chrono::seconds(1);
  EXPECT_EQ(writer.Publish(absl::Seconds(1))->gas_quality.failures, failures + 1);
  EXPECT_EQ(writer.unpublished_since(), now);
  EXPECT_EQ(writer.gas_timings().update.samples, updates);
}

TEST(MissionWriterGas, RefusedReadingsAreNotWaitedFor) {
  MissionWriter writer(std::make_unique<Mission>(MissionOptions{}), nullptr);
  ASSERT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
  auto batch = GasBatch(1, 1);
  batch[0].observation.pose.x_m = 1e9;
  writer.conduct().Ingest("r1", kLease, std::move(batch));
  EXPECT_EQ(writer.unpublished_since(), SteadyTime::max());
}

}  // namespace mission_writer_test
}  // namespace plumescout::server
