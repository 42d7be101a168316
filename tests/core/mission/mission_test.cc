// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/mission.h"

#include <cmath>
#include <vector>

#include "core/plan/strategy.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/core/mission/mission_peer.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::unique_ptr<Mission> MissionWith(std::initializer_list<const char*> robots,
                                     const MissionOptions& options = {}) {
  auto mission = Mission::Create(options);
  EXPECT_TRUE(mission.ok());
  for (const char* robot : robots)
    EXPECT_TRUE((*mission)->Apply(RobotRegistered{robot, 0.2, 1}).ok());
  return *std::move(mission);
}

// A robot may come from anywhere to anywhere.
MissionOptions FromAnywhere() {
  MissionOptions options;
  options.max_robot_speed_mps = 0.0;
  return options;
}

// One robot measures and plans its way through a room; every event lands in the log.
std::vector<EventBody> RecordRun(Mission& mission) {
  std::vector<EventBody> log;
  const auto apply = [&](EventBody body) {
    const auto applied = mission.Apply(body);
    EXPECT_TRUE(applied.ok()) << applied.status();
    log.push_back(std::move(body));
    return applied.ok() ? *applied : Applied{};
  };
  PlanningOptions planning;
  const auto strategy = MakeStrategy(planning);
  EXPECT_TRUE(strategy.ok()) << strategy.status();
  apply(RobotRegistered{"a", 0.2, 1});
  Pose2 pose{1.0, 1.0, 0.0};
  std::int64_t sequence = 0;
  for (int step = 0; step < 12; ++step) {
    const std::int64_t now_ns = (step + 1) * kSecond_ns;
    apply(ObservationReceived{"a", {++sequence, now_ns, pose, support::ScanInBox(pose, 6.0, 4.0)}});
    apply(ObservationReceived{"a", {++sequence, now_ns, pose, GasReading{2.0 * step, 0.0}}});
    apply(PosteriorRefreshed{now_ns});
    if (step % 4 == 2) apply(EpochBegun{now_ns});
    if (step % 4 == 3) apply(EpochAdopted{});
    PlanRequest request;
    request.robot = "a";
    auto plan = (*strategy)->Plan(*mission.Snapshot(), request, NeverStop());
    EXPECT_TRUE(plan.ok()) << plan.status();
    if (!plan.ok()) break;
    if (!plan->trajectory.waypoints.empty()) pose = plan->trajectory.waypoints.back().pose;
    const Applied issued = apply(PlanIssued{*plan});
    apply(ProgressReported{"a", issued.plan_id, ProgressOutcome::kReached});
  }
  return log;
}

TEST(Mission, ReplayingTheSameEventsGivesTheSameBytes) {
  const auto original = MissionWith({});
  const std::vector<EventBody> log = RecordRun(*original);
  const auto replay = MissionWith({});
  for (const EventBody& body : log) ASSERT_TRUE(replay->Apply(body).ok());

  const auto a = original->Snapshot();
  const auto b = replay->Snapshot();
  EXPECT_EQ(a->revision, b->revision);
  EXPECT_EQ(a->revision, static_cast<std::int64_t>(log.size()));
  EXPECT_TRUE(support::SameBytes(*a->occupancy, *b->occupancy));
  EXPECT_TRUE(support::SameBytes(*a->traversable, *b->traversable));
  EXPECT_TRUE(support::SameBytes(*a->gas_mean_ppm, *b->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*a->gas_variance_ppm2, *b->gas_variance_ppm2));
  EXPECT_EQ(a->gas_counters, b->gas_counters);
  EXPECT_EQ(a->gas_quality, b->gas_quality);
  EXPECT_EQ(a->gas_quality.epochs, 3);
  EXPECT_EQ(a->phase, b->phase);
}

// A defect that lasts while the mission is replayed; the events say when it struck.
TEST(Mission, AFieldThatCannotBeComputedIsPartOfTheReplay) {
  const Pose2 pose{1.0, 1.0, 0.0};
  std::shared_ptr<const Belief> beliefs[2];
  for (const bool watched : {false, true}) {
    const auto mission = MissionWith({"a"});
    std::int64_t sequence = 0;
    const auto scan = [&](double side_m) {
      ++sequence;
      const Scan room = support::ScanInBox(pose, side_m, side_m);
      EXPECT_TRUE(
          mission->Apply(ObservationReceived{"a", {sequence, sequence * kSecond_ns, pose, room}})
              .ok());
    };
    for (int k = 0; k < 3; ++k) scan(3.0);
    ASSERT_TRUE(mission->Apply(PosteriorRefreshed{3 * kSecond_ns}).ok());
    ASSERT_TRUE(mission->Apply(EpochBegun{3 * kSecond_ns}).ok());
    if (watched) mission->Snapshot();
    GasMapPeer::LosePrior(MissionPeer::Gas(*mission));
    for (int k = 0; k < 3; ++k) scan(60.0);  // outgrows the lattice
    const std::int64_t revision = mission->revision();
    if (GasMapPeer::kStopsAtDefects) {
      EXPECT_DEATH(mission->Apply(PosteriorRefreshed{6 * kSecond_ns}).IgnoreError(),
                   GasMapPeer::kDefect);
      return;
    }
    const auto refreshed = mission->Apply(PosteriorRefreshed{6 * kSecond_ns});
    ASSERT_TRUE(refreshed.ok());
    EXPECT_EQ(refreshed->revision, revision + 1);
    EXPECT_EQ(refreshed->posterior.code(), absl::StatusCode::kInternal);
    EXPECT_TRUE(mission->posterior_stale());
    EXPECT_FALSE(mission->refresh_due()) << "to be tried again, but not at once";
    EXPECT_EQ(mission->epoch(), nullptr);
    beliefs[watched] = mission->Snapshot();
    EXPECT_EQ(beliefs[watched]->posterior_time_ns, 3 * kSecond_ns);
    EXPECT_EQ(beliefs[watched]->gas_quality.failures, 1);

    GasMapPeer::FindPrior(MissionPeer::Gas(*mission));
    ASSERT_TRUE(mission->Apply(PosteriorRefreshed{7 * kSecond_ns})->posterior.ok());
    EXPECT_EQ(mission->Snapshot()->posterior_time_ns, 7 * kSecond_ns);
  }
  EXPECT_TRUE(support::SameBytes(*beliefs[0]->gas_mean_ppm, *beliefs[1]->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*beliefs[0]->gas_variance_ppm2, *beliefs[1]->gas_variance_ppm2));
  EXPECT_EQ(beliefs[0]->gas_quality, beliefs[1]->gas_quality);
}

TEST(Mission, RefusedObservationsCountAsAppliedAndChangeNothingElse) {
  const auto mission = MissionWith({"a"});
  const auto before = mission->Snapshot();
  const auto applied =
      mission->Apply(ObservationReceived{"a", {1, kSecond_ns, {NAN, 0, 0}, GasReading{1.0, 0.0}}});
  ASSERT_TRUE(applied.ok());
  EXPECT_EQ(applied->observation.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(*mission->AppliedSequence("a"), 1);
  const auto after = mission->Snapshot();
  EXPECT_EQ(after->robots.at("a").state.rejected_observations, 1);
  EXPECT_FALSE(after->robots.at("a").state.has_pose);
  EXPECT_EQ(after->gas_counters, before->gas_counters);
  EXPECT_EQ(after->sample_time_ns, 0);
}

// A room of 3 m x 3 m, seen from its middle.
TEST(Mission, EveryReadingIsCountedWhateverBecomesOfIt) {
  const auto mission = MissionWith({"a"}, FromAnywhere());
  std::int64_t sequence = 0;
  const auto observe = [&](std::int64_t time_ns, Pose2 pose, auto payload) {
    const auto applied =
        mission->Apply(ObservationReceived{"a", {++sequence, time_ns, pose, payload}});
    return applied.ok() ? applied->observation : applied.status();
  };
  const Pose2 middle{1.5, 1.5, 0.0};
  constexpr std::int64_t kBegin_ns = 1'000 * kSecond_ns;
  constexpr std::int64_t kHour_ns = 3600 * kSecond_ns;
  ASSERT_TRUE(observe(kBegin_ns, middle, GasReading{1.0, 0.0}).ok()) << "before any map";
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(observe(kBegin_ns, middle, support::ScanInBox(middle, 3.0, 3.0)).ok());
  }
  EXPECT_TRUE(observe(0, middle, GasReading{1.0, 0.0}).ok()) << "older than the mission";
  EXPECT_TRUE(observe(kBegin_ns + kHour_ns, middle, GasReading{1.0, 0.0}).ok()) << "from later";
  EXPECT_TRUE(observe(kBegin_ns, middle, GasReading{0.0, 1e-9}).ok()) << "all but certain";
  EXPECT_TRUE(observe(kBegin_ns, middle, GasReading{1e6, 1e12}).ok()) << "all but void";
  EXPECT_TRUE(observe(kBegin_ns, {1.5, 3.02, 0.0}, GasReading{1.0, 0.0}).ok()) << "in a wall";
  EXPECT_TRUE(observe(kBegin_ns, {1.5, 4.0, 0.0}, GasReading{1.0, 0.0}).ok()) << "in the unknown";
  EXPECT_TRUE(observe(kBegin_ns, {900.0, -900.0, 0.0}, GasReading{1.0, 0.0}).ok()) << "off the map";
  EXPECT_FALSE(observe(kBegin_ns, {1001.0, 0.0, 0.0}, GasReading{1.0, 0.0}).ok());
  for (const double bad : {-1.0, static_cast<double>(NAN), 1e7}) {
    EXPECT_FALSE(observe(kBegin_ns, middle, GasReading{bad, 0.0}).ok());
  }
  for (const double bad : {-1.0, static_cast<double>(NAN), 1e13, 1e-10}) {
    EXPECT_FALSE(observe(kBegin_ns, middle, GasReading{1.0, bad}).ok());
  }
  EXPECT_FALSE(observe(-1, middle, GasReading{1.0, 0.0}).ok());
  EXPECT_FALSE(observe(kBegin_ns + 26 * kHour_ns, middle, GasReading{1.0, 0.0}).ok());
  EXPECT_EQ(mission->sample_time_ns(), kBegin_ns + kHour_ns);
  ASSERT_TRUE(mission->Apply(PosteriorRefreshed{mission->sample_time_ns()})->posterior.ok());

  const auto belief = mission->Snapshot();
  EXPECT_EQ(belief->gas_counters,
            (GasCounters{.readings = 8, .in_posterior = 6, .moved_to_neighbour = 1, .waiting = 2}));
  EXPECT_EQ(belief->robots.at("a").state.rejected_observations, 10);
  EXPECT_EQ(belief->robots.at("a").state.applied_sequence, sequence);
  for (std::size_t i = 0; i < belief->occupancy->size(); ++i) {
    if ((*belief->occupancy)[i] != CellState::kFree) continue;
    EXPECT_TRUE(std::isfinite((*belief->gas_mean_ppm)[i]));
    EXPECT_GT((*belief->gas_variance_ppm2)[i], 0.0F);
  }
}

TEST(Mission, ScansBeyondTheLargestMapAreRefused) {
  const auto mission = MissionWith({"a"}, FromAnywhere());
  const Pose2 far{900.0, 0.0, 0.0};
  const Pose2 near{0.0, 0.0, 0.0};
  ASSERT_TRUE(mission
                  ->Apply(ObservationReceived{
                      "a", {1, kSecond_ns, near, support::ScanInBox({1, 1, 0}, 4, 4)}})
                  ->observation.ok());
  const auto applied = mission->Apply(
      ObservationReceived{"a", {2, kSecond_ns, far, support::ScanInBox({1, 1, 0}, 4, 4)}});
  ASSERT_TRUE(applied.ok());
  EXPECT_EQ(applied->observation.code(), absl::StatusCode::kResourceExhausted);
}

TEST(Mission, ErrorsLeaveTheRevisionAlone) {
  const auto mission = MissionWith({"a"});
  const std::int64_t revision = mission->revision();
  EXPECT_FALSE(mission->Apply(ObservationReceived{"ghost", {}}).ok());
  EXPECT_FALSE(mission->Apply(ObservationReceived{"a", {5, 0, {}, GasReading{}}}).ok());
  EXPECT_FALSE(mission->Apply(PosteriorRefreshed{-1}).ok());
  EXPECT_EQ(mission->Apply(EpochBegun{-1}).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_FALSE(mission->Apply(ProgressReported{"a", 1, ProgressOutcome::kReached}).ok());
  Plan stale;
  stale.robot = "a";
  stale.belief_revision = revision + 1;
  EXPECT_EQ(mission->Apply(PlanIssued{stale}).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(mission->revision(), revision);
}

TEST(Mission, RobotsDrivingTowardsEachOtherAreNotWalls) {
  const auto mission = MissionWith({"left", "right"});
  std::int64_t sequence = 0;
  for (double gap_m = 3.0; gap_m > 0.8; gap_m -= 0.2) {
    const Pose2 left{3.0 - gap_m / 2, 2.0, 0.0};
    const Pose2 right{3.0 + gap_m / 2, 2.0, M_PI};
    ++sequence;
    const std::int64_t now_ns = sequence * kSecond_ns / 5;
    for (const auto& [robot, self, other] :
         {std::tuple{"left", left, right}, std::tuple{"right", right, left}}) {
      // Each sees the other's body as a disc of 0.2 m in its scan.
      const Scan scan = support::ScanInBox(self, 6.0, 4.0, {{other.position(), 0.2}});
      ASSERT_TRUE(mission->Apply(ObservationReceived{robot, {sequence, now_ns, self, scan}}).ok());
    }
  }
  const auto belief = mission->Snapshot();
  for (double x_m = 1.5; x_m < 4.5; x_m += 0.1) {
    const Cell cell = belief->geometry().CellAt({x_m, 2.0});
    EXPECT_NE((*belief->occupancy)[cell], CellState::kOccupied) << "at x = " << x_m;
  }
}

TEST(Mission, TheFirstScanOfARobotNextToAnotherNeedsItsPoseToMaskIt) {
  const auto mission = MissionWith({"a", "b"});
  const Pose2 a{2.0, 2.0, 0.0};
  const Pose2 b{3.5, 2.0, 0.0};
  ASSERT_TRUE(
      mission->Apply(ObservationReceived{"b", {1, kSecond_ns, b, GasReading{0.0, 0.0}}}).ok());
  const Scan scan = support::ScanInBox(a, 6.0, 4.0, {{b.position(), 0.2}});
  ASSERT_TRUE(mission->Apply(ObservationReceived{"a", {1, kSecond_ns, a, scan}}).ok());
  const auto belief = mission->Snapshot();
  EXPECT_NE((*belief->occupancy)[belief->geometry().CellAt({3.32, 2.0})], CellState::kOccupied);
}

TEST(Mission, SnapshotsStayWhatTheyWere) {
  const auto mission = MissionWith({"a"});
  const Pose2 pose{1.0, 1.0, 0.0};
  ASSERT_TRUE(mission
                  ->Apply(ObservationReceived{
                      "a", {1, kSecond_ns, pose, support::ScanInBox(pose, 3.0, 3.0)}})
                  .ok());
  const auto before = mission->Snapshot();
  const Grid<CellState> copy = *before->occupancy;
  EXPECT_EQ(before->occupancy.get(), mission->Snapshot()->occupancy.get()) << "shared, not copied";
  ASSERT_TRUE(mission
                  ->Apply(ObservationReceived{
                      "a", {2, kSecond_ns, pose, support::ScanInBox(pose, 2.5, 2.5)}})
                  .ok());
  ASSERT_TRUE(mission->Apply(PosteriorRefreshed{kSecond_ns}).ok());
  EXPECT_NE(before->occupancy.get(), mission->Snapshot()->occupancy.get());
  EXPECT_TRUE(support::SameBytes(*before->occupancy, copy));
}

TEST(Mission, EpochsBeginAndAreAdoptedInTurn) {
  const auto mission = MissionWith({"a"});
  EXPECT_EQ(mission->Apply(EpochAdopted{}).status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(mission->Apply(EpochBegun{kSecond_ns}).status().code(),
            absl::StatusCode::kFailedPrecondition)
      << "no field yet";
  EXPECT_EQ(mission->epoch(), nullptr);
  const Pose2 pose{1.0, 1.0, 0.0};
  for (std::int64_t sequence = 1; sequence <= 3; ++sequence) {
    ASSERT_TRUE(mission
                    ->Apply(ObservationReceived{
                        "a", {sequence, kSecond_ns, pose, support::ScanInBox(pose, 3.0, 3.0)}})
                    .ok());
  }
  ASSERT_TRUE(mission->Apply(PosteriorRefreshed{kSecond_ns}).ok());
  EXPECT_EQ(mission->Apply(EpochBegun{-1}).status().code(), absl::StatusCode::kInvalidArgument);
  const std::int64_t revision = mission->revision();
  ASSERT_TRUE(mission->Apply(EpochBegun{kSecond_ns}).ok());
  EXPECT_NE(mission->epoch(), nullptr);
  EXPECT_FALSE(mission->epoch_due());
  EXPECT_EQ(mission->Apply(EpochBegun{kSecond_ns}).status().code(),
            absl::StatusCode::kFailedPrecondition);
  ASSERT_TRUE(mission->Apply(EpochAdopted{}).ok());
  EXPECT_EQ(mission->epoch(), nullptr);
  EXPECT_FALSE(mission->adoption_due());
  EXPECT_EQ(mission->Snapshot()->gas_quality.epochs, 1);
  EXPECT_EQ(mission->revision(), revision + 2);
}

TEST(Mission, WhoRecomputesAnEpochDoesNotShow) {
  std::shared_ptr<const Belief> beliefs[2];
  for (const bool beside : {false, true}) {
    const auto mission = MissionWith({});
    RecordRun(*mission);
    ASSERT_TRUE(mission->Apply(EpochBegun{20 * kSecond_ns}).ok());
    if (beside) mission->epoch()->Recompute();
    ASSERT_TRUE(mission->Apply(EpochAdopted{}).ok());
    beliefs[beside] = mission->Snapshot();
  }
  EXPECT_TRUE(support::SameBytes(*beliefs[0]->gas_mean_ppm, *beliefs[1]->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*beliefs[0]->gas_variance_ppm2, *beliefs[1]->gas_variance_ppm2));
  EXPECT_EQ(beliefs[0]->gas_quality, beliefs[1]->gas_quality);
}

TEST(Mission, RefreshIsDueAfterItsPeriodOfSampleTime) {
  MissionOptions options;
  options.gas.refresh_period_s = 2.0;
  const auto mission = MissionWith({"a"}, options);
  EXPECT_FALSE(mission->posterior_stale());
  const auto gas = [&](std::int64_t sequence, std::int64_t time_ns) {
    return mission->Apply(ObservationReceived{"a", {sequence, time_ns, {}, GasReading{1.0, 0.0}}});
  };
  ASSERT_TRUE(gas(1, 10 * kSecond_ns).ok());
  EXPECT_TRUE(mission->posterior_stale());
  EXPECT_TRUE(mission->refresh_due());
  ASSERT_TRUE(mission->Apply(PosteriorRefreshed{10 * kSecond_ns}).ok());
  EXPECT_FALSE(mission->posterior_stale());
  ASSERT_TRUE(gas(2, 11 * kSecond_ns).ok());
  EXPECT_FALSE(mission->refresh_due());
  ASSERT_TRUE(gas(3, 12 * kSecond_ns).ok());
  EXPECT_TRUE(mission->refresh_due());
}

TEST(Mission, AReadingDoesNotWaitForTheRefreshThatAScanCaused) {
  MissionOptions options;
  options.gas.refresh_period_s = 2.0;
  const auto mission = MissionWith({"a"}, options);
  const Pose2 pose{1.0, 1.0, 0.0};
  std::int64_t sequence = 0;
  const auto observe = [&](std::int64_t time_ns, auto payload) {
    return mission->Apply(ObservationReceived{"a", {++sequence, time_ns, pose, payload}});
  };
  const Scan scan = support::ScanInBox(pose, 3.0, 3.0);
  ASSERT_TRUE(observe(10 * kSecond_ns, scan).ok());
  EXPECT_TRUE(mission->refresh_due());
  ASSERT_TRUE(mission->Apply(PosteriorRefreshed{10 * kSecond_ns}).ok());
  ASSERT_TRUE(observe(11 * kSecond_ns, scan).ok());
  EXPECT_FALSE(mission->refresh_due());
  ASSERT_TRUE(observe(11 * kSecond_ns, GasReading{1.0, 0.0}).ok());
  EXPECT_TRUE(mission->refresh_due());
  ASSERT_TRUE(mission->Apply(PosteriorRefreshed{11 * kSecond_ns}).ok());
  ASSERT_TRUE(observe(12 * kSecond_ns, GasReading{1.0, 0.0}).ok());
  EXPECT_FALSE(mission->refresh_due()) << "readings, too, bring about one refresh a period";
}

TEST(MissionCreate, RefusesInvalidOptions) {
  MissionOptions options;
  options.gas.prior_precision_per_ppm2 = NAN;
  EXPECT_EQ(Mission::Create(options).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace mission_test
}  // namespace plumescout
