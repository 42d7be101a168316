// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// When the gas posterior is brought up to date and recomputed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/mission/conduct/mission_conduct.h"
#include "tests/core/mission/mission_peer.h"
#include "tests/support/ingest_batch.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_conduct_gas_test {

using support::FastAgeing;
using support::GasBatch;
using support::RoomRunBatch;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kLease = 7;

bool IsGasEvent(const EventBody& body) {
  return std::holds_alternative<EpochAdopted>(body) ||
         std::holds_alternative<PosteriorRefreshed>(body) ||
         std::holds_alternative<EpochBegun>(body);
}

// Writes down what it is told: "<" before a step, its event's kind as the step's name, ">" after it
// or "!" if it failed.
struct Listener final : ConductObserver {
  static std::string Name(GasStep step) {
    switch (step) {
      case GasStep::kAdoptEpoch:
        return "adopt";
      case GasStep::kRefresh:
        return "refresh";
      case GasStep::kBeginEpoch:
        return "begin";
    }
    return "?";
  }
  void OnEvent(const Event& event, const Applied&) override {
    events.push_back(event);
    if (IsGasEvent(event.body)) told.push_back("event");
  }
  void BeforeGasStep(GasStep step) override { told.push_back("<" + Name(step)); }
  void AfterGasStep(GasStep step, const absl::Status& status) override {
    told.push_back((status.ok() ? ">" : "!") + Name(step));
    if (status.ok() && step == GasStep::kAdoptEpoch) ++adopted;
  }

  std::vector<Event> events;
  std::vector<std::string> told;
  int adopted = 0;
};

std::unique_ptr<Mission> WithoutField() {
  auto mission = std::make_unique<Mission>(FastAgeing());
  GasMapPeer::LosePrior(MissionPeer::Gas(*mission));
  return mission;
}

// A mission that robot r1 has joined.
struct Conducted {
  explicit Conducted(std::unique_ptr<Mission> mission = std::make_unique<Mission>(FastAgeing()))
      : conduct(std::move(mission), &listener) {
    EXPECT_TRUE(conduct.Register(RobotRegistered{"r1", 0.2, kLease}).ok());
  }
  Listener listener;
  MissionConduct conduct;
};

// After the run of RoomRunBatch() up to the first epoch; returns the entries that are left.
std::vector<IncomingObservation> RunUntilEpoch(MissionConduct& conduct) {
  std::vector<IncomingObservation> rest;
  for (IncomingObservation& incoming : RoomRunBatch()) {
    if (conduct.mission().epoch() != nullptr) {
      rest.push_back(std::move(incoming));
      continue;
    }
    std::vector<IncomingObservation> one;
    one.push_back(std::move(incoming));
    EXPECT_TRUE(conduct.Ingest("r1", kLease, std::move(one)).status.ok());
  }
  EXPECT_FALSE(rest.empty());
  return rest;
}

void ExpectSame(const Belief& a, const Belief& b) {
  EXPECT_EQ(a.revision, b.revision);
  EXPECT_EQ(*a.occupancy, *b.occupancy);
  EXPECT_TRUE(support::SameBytes(*a.gas_mean_ppm, *b.gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*a.gas_variance_ppm2, *b.gas_variance_ppm2));
  EXPECT_EQ(a.gas_quality, b.gas_quality);
}

TEST(MissionConductGas, FreshBeliefRefreshesOnceAndSnapshotNever) {
  Conducted run;
  run.conduct.Ingest("r1", kLease, GasBatch(1, 1));
  const std::int64_t revision = run.conduct.mission().revision();
  EXPECT_EQ(run.conduct.Snapshot()->revision, revision);
  EXPECT_EQ(run.conduct.BeliefFor({.fresh_posterior = false}).value()->revision, revision);
  EXPECT_EQ(run.conduct.BeliefFor({}).value()->revision, revision + 1);
  EXPECT_EQ(run.conduct.FreshBelief().value()->revision, revision + 1);
  EXPECT_THAT(run.listener.told, ElementsAre("<refresh", "event", ">refresh"));
}

TEST(MissionConductGas, ReadingsBringRefreshesAboutBySampleTime) {
  Conducted run(std::make_unique<Mission>(MissionOptions{}));
  const auto period_ns = static_cast<std::int64_t>(MissionOptions{}.gas.refresh_period_s * 1e9);
  auto batch = GasBatch(1, 2);
  batch[1].observation.sample_time_ns = period_ns - 1;
  ASSERT_TRUE(run.conduct.Ingest("r1", kLease, batch).status.ok());
  EXPECT_THAT(run.listener.told, IsEmpty());
  auto last = GasBatch(3, 3);
  last[0].observation.sample_time_ns = period_ns;
  ASSERT_TRUE(run.conduct.Ingest("r1", kLease, std::move(last)).status.ok());
  EXPECT_EQ(run.listener.events.back().body, EventBody(PosteriorRefreshed{period_ns}));
}

// Three robots that send a reading each in rounds.
struct Rounds {
  Rounds() : run(std::make_unique<Mission>(MissionOptions{})) {
    for (const char* const robot : {"r2", "r3"}) {
      EXPECT_TRUE(run.conduct.Register(RobotRegistered{robot, 0.2, kLease}).ok());
    }
  }
  // Returns whether that brought a refresh about.
  bool Send(const RobotId& robot, std::int64_t time_ms) {
    auto one = GasBatch(sequences[robot] + 1, sequences[robot] + 1);
    ++sequences[robot];
    one[0].observation.sample_time_ns = time_ms * 1'000'000;
    run.listener.told.clear();
    EXPECT_TRUE(run.conduct.Ingest(robot, kLease, std::move(one)).status.ok());
    return !run.listener.told.empty();
  }

  Conducted run;
  std::map<RobotId, std::int64_t> sequences;
};

TEST(MissionConductGas, RefreshesOfATeamComeAfterItsRounds) {
  Rounds team;
  team.Send("r1", 100);
  team.Send("r2", 101);
  team.Send("r3", 102);
  for (std::int64_t round_ms = 200; round_ms < 1000; round_ms += 100) {
    EXPECT_FALSE(team.Send("r1", round_ms)) << round_ms;
    EXPECT_FALSE(team.Send("r2", round_ms + 1)) << round_ms;
    EXPECT_TRUE(team.Send("r3", round_ms + 2)) << round_ms;
  }
}

TEST(MissionConductGas, RobotsOutOfStepHaveARefreshAfterEachHasSent) {
  Rounds team;
  for (const char* const robot : {"r1", "r2", "r3"}) team.Send(robot, 100);
  int refreshes = 0;
  for (std::int64_t time_ms = 200; time_ms < 1200; time_ms += 100) {
    refreshes += team.Send("r1", time_ms) ? 1 : 0;
    refreshes += team.Send("r2", time_ms + 33) ? 1 : 0;
    refreshes += team.Send("r3", time_ms + 66) ? 1 : 0;
  }
  EXPECT_GE(refreshes, 7) << "in a second";
}

TEST(MissionConductGas, NobodyIsWaitedForForLong) {
  Rounds team;
  for (const char* const robot : {"r1", "r2", "r3"}) team.Send(robot, 100);
  std::vector<std::int64_t> refreshed_ms;
  for (std::int64_t time_ms = 200; time_ms < 800; time_ms += 100) {
    if (team.Send("r1", time_ms)) refreshed_ms.push_back(time_ms);
    if (team.Send("r2", time_ms)) refreshed_ms.push_back(time_ms);
  }
  EXPECT_THAT(refreshed_ms, ElementsAre(400, 500, 600, 700)) << "of r3 nothing more is heard";
}

TEST(MissionConductGas, EventsDoNotDependOnHowTheLogWasCut) {
  Conducted whole;
  ASSERT_TRUE(whole.conduct.Ingest("r1", kLease, RoomRunBatch()).status.ok());
  Conducted cut;
  for (IncomingObservation& incoming : RoomRunBatch()) {
    std::vector<IncomingObservation> batch;
    batch.push_back(std::move(incoming));
    ASSERT_TRUE(cut.conduct.Ingest("r1", kLease, std::move(batch)).status.ok());
  }
  EXPECT_GE(whole.listener.adopted, 1);
  EXPECT_EQ(cut.listener.events, whole.listener.events);
}

TEST(MissionConductGas, EventsOfOneObservationComeInTheirOrder) {
  Conducted run;
  ASSERT_TRUE(run.conduct.Ingest("r1", kLease, RoomRunBatch()).status.ok());
  // Within the events between two observations the kinds come in this order, once each at most.
  const auto rank = [](const EventBody& body) {
    if (std::holds_alternative<EpochAdopted>(body)) return 1;
    if (std::holds_alternative<PosteriorRefreshed>(body)) return 2;
    return std::holds_alternative<EpochBegun>(body) ? 3 : 0;
  };
  const std::vector<Event>& events = run.listener.events;
  for (std::size_t i = 1; i < events.size(); ++i) {
    const int here = rank(events[i].body);
    EXPECT_TRUE(here == 0 || rank(events[i - 1].body) < here) << "event " << i + 1;
  }
}

TEST(MissionConductGas, EachStepIsToldAroundItsEvent) {
  Conducted run;
  ASSERT_TRUE(run.conduct.Ingest("r1", kLease, RoomRunBatch()).status.ok());
  const std::vector<std::string>& told = run.listener.told;
  ASSERT_EQ(told.size() % 3, 0U);
  for (std::size_t i = 0; i < told.size(); i += 3) {
    EXPECT_EQ(told[i].front(), '<');
    EXPECT_EQ(told[i + 1], "event");
    EXPECT_EQ(told[i + 2], ">" + told[i].substr(1));
  }
}

TEST(MissionConductGas, EpochOutOfTurnIsAnOrdinaryEventAndAdoptedInItsTime) {
  MissionOptions slow;  // so that epochs do not follow each other at once
  slow.gas.ageing_half_life_s = 300.0;
  Conducted run(std::make_unique<Mission>(slow));
  const auto rest = RunUntilEpoch(run.conduct);
  EXPECT_TRUE(absl::IsFailedPrecondition(run.conduct.BeginEpoch()));  // one is under way
  EXPECT_EQ(run.listener.told.back(), "!begin");
  std::size_t at = 0;
  for (; run.listener.adopted == 0 || run.conduct.mission().epoch() != nullptr; ++at) {
    ASSERT_LT(at, rest.size());
    ASSERT_TRUE(run.conduct.Ingest("r1", kLease, {rest[at]}).status.ok());
  }
  const int adopted = run.listener.adopted;
  ASSERT_FALSE(run.conduct.mission().epoch_due());
  ASSERT_TRUE(run.conduct.BeginEpoch().ok());
  EXPECT_NE(run.conduct.mission().epoch(), nullptr);
  for (; run.listener.adopted == adopted; ++at) {
    ASSERT_LT(at, rest.size());
    ASSERT_TRUE(run.conduct.Ingest("r1", kLease, {rest[at]}).status.ok());
  }

  Mission replayed(slow);
  for (const Event& event : run.listener.events) ASSERT_TRUE(replayed.Apply(event.body).ok());
  ExpectSame(*replayed.Snapshot(), *run.conduct.Snapshot());
}

TEST(MissionConductGas, RefreshOutOfTurnIsAnOrdinaryEvent) {
  Conducted run;
  run.conduct.Ingest("r1", kLease, GasBatch(1, 2));
  ASSERT_TRUE(run.conduct.Refresh().ok());
  EXPECT_FALSE(run.conduct.mission().posterior_stale());
  EXPECT_EQ(run.listener.events.back().body,
            EventBody(PosteriorRefreshed{run.conduct.mission().sample_time_ns()}));
}

TEST(MissionConductGas, FieldThatCannotBeComputedStopsNoLogAndIsToldAndRecorded) {
  Conducted run(WithoutField());
  if (GasMapPeer::kStopsAtDefects) {
    EXPECT_DEATH(run.conduct.Ingest("r1", kLease, RoomRunBatch()), GasMapPeer::kDefect);
    return;
  }
  const auto batch = RoomRunBatch();
  const IngestResult result = run.conduct.Ingest("r1", kLease, batch);
  ASSERT_TRUE(result.status.ok()) << result.status;
  EXPECT_EQ(result.position.applied_sequence, batch.back().observation.sequence);
  EXPECT_EQ(run.conduct.FreshBelief().status().code(), absl::StatusCode::kInternal);
  EXPECT_EQ(run.listener.told.back(), "!refresh");
  const auto belief = run.conduct.Snapshot();
  EXPECT_GT(belief->gas_quality.failures, 1);
  EXPECT_TRUE(std::holds_alternative<PosteriorRefreshed>(run.listener.events.back().body));

  const auto replayed = WithoutField();
  for (const Event& event : run.listener.events) ASSERT_TRUE(replayed->Apply(event.body).ok());
  ExpectSame(*replayed->Snapshot(), *belief);
}

TEST(MissionConductGas, AFieldThatAnAuditBlamesIsMadeAnewByAnEventThatReplays) {
  Conducted run(std::make_unique<Mission>(MissionOptions{}));
  const std::vector<IncomingObservation> log = RoomRunBatch();
  const auto middle = log.begin() + static_cast<std::ptrdiff_t>(log.size() / 2);
  ASSERT_TRUE(run.conduct.Ingest("r1", kLease, {log.begin(), middle}).status.ok());
  ASSERT_EQ(run.conduct.mission().epoch(), nullptr) << "nothing is due";
  const auto finding = [&] { return RunAudit(*run.conduct.mission().MakeAudit()).value(); };
  run.conduct.TakeFinding(finding());
  EXPECT_EQ(run.conduct.Snapshot()->gas_audits.audits, 1);
  EXPECT_EQ(run.conduct.Snapshot()->gas_audits.alarms, 0);
  EXPECT_EQ(run.conduct.mission().epoch(), nullptr) << "nothing is to be mended";

  GasMap& gas = MissionPeer::Gas(const_cast<Mission&>(run.conduct.mission()));
  const Belief before = *run.conduct.Snapshot();
  std::size_t free = 0;
  while ((*before.occupancy)[free] != CellState::kFree) ++free;
  const AnchorCell corner = gas.MakeAudit()->corner;
  const Cell cell = before.occupancy->geometry().CellAtIndex(free);
  GasMapPeer::Mislead(gas, {corner.x + cell.x, corner.y + cell.y}, 50.0);
  const AuditFinding blame = finding();
  EXPECT_FALSE(blame.certified);
  run.conduct.TakeFinding(blame);
  EXPECT_EQ(run.conduct.Snapshot()->gas_audits.audits, 2);
  EXPECT_EQ(run.conduct.Snapshot()->gas_audits.alarms, 1);
  EXPECT_EQ(run.conduct.Snapshot()->gas_audits.mean_ppm, blame.mean_ppm);
  EXPECT_TRUE(std::holds_alternative<EpochBegun>(run.listener.events.back().body));
  run.conduct.TakeFinding(blame);
  EXPECT_EQ(run.conduct.Snapshot()->gas_audits.alarms, 2);
  EXPECT_TRUE(std::holds_alternative<EpochBegun>(run.listener.events.back().body))
      << "the epoch under way will do";

  ASSERT_TRUE(run.conduct.Ingest("r1", kLease, {middle, log.end()}).status.ok());
  EXPECT_GE(run.listener.adopted, 1);
  ASSERT_EQ(run.conduct.mission().epoch(), nullptr);
  EXPECT_TRUE(finding().certified);

  Mission replayed{MissionOptions{}};
  for (const Event& event : run.listener.events) ASSERT_TRUE(replayed.Apply(event.body).ok());
  const auto a = run.conduct.Snapshot();
  const auto b = replayed.Snapshot();
  EXPECT_TRUE(support::SameBytes(*a->gas_mean_ppm, *b->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*a->gas_variance_ppm2, *b->gas_variance_ppm2));
}

}  // namespace mission_conduct_gas_test
}  // namespace plumescout
