// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/mission/mission.h"
#include "core/plan/strategy.h"
#include "core/types/prior_map.h"
#include "tests/core/mission/mission_peer.h"
#include "tests/core/mission/random_mission.h"
#include "tests/support/room_run.h"
#include "tests/support/rounds.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_state_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// What Apply says of an event.
std::string Outcome(const absl::StatusOr<Applied>& applied) {
  if (!applied.ok()) return applied.status().ToString();
  return absl::StrCat(applied->revision, " ", applied->observation.ToString(), " ",
                      applied->posterior.ToString(), " ", applied->plan_id);
}

// Something that was tried on a mission, and what came of it.
struct Step {
  EventBody body;
  std::string outcome;
  std::uint64_t digest = 0;  // afterwards
  std::string state;         // likewise, if it can be saved
};

void ExpectSameBeliefs(const Mission& a_mission, const Mission& b_mission) {
  const auto a = a_mission.Snapshot();
  const auto b = b_mission.Snapshot();
  EXPECT_EQ(a->revision, b->revision);
  EXPECT_EQ(a->posterior_time_ns, b->posterior_time_ns);
  EXPECT_TRUE(support::SameBytes(*a->occupancy, *b->occupancy));
  EXPECT_TRUE(support::SameBytes(*a->traversable, *b->traversable));
  EXPECT_TRUE(support::SameBytes(*a->gas_mean_ppm, *b->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*a->gas_variance_ppm2, *b->gas_variance_ppm2));
  EXPECT_TRUE(support::SameBytes(*a->sampled, *b->sampled));
  EXPECT_EQ(a->gas_what_if == nullptr, b->gas_what_if == nullptr);
  EXPECT_EQ(a->gas_counters, b->gas_counters);
  EXPECT_EQ(a->gas_quality, b->gas_quality);
  EXPECT_EQ(a->robots.size(), b->robots.size());
  EXPECT_EQ(a->claims.size(), b->claims.size());
  EXPECT_EQ(a->set_aside.size(), b->set_aside.size());
  EXPECT_EQ(a->phase, b->phase);
  EXPECT_EQ(a->next_map_update_ns, b->next_map_update_ns);
  EXPECT_EQ(a_mission.memory_bytes(), b_mission.memory_bytes());
  EXPECT_EQ(a_mission.lattice_factor(), b_mission.lattice_factor());
  const auto strategy = MakeStrategy(PlanningOptions());
  ASSERT_TRUE(strategy.ok());
  for (const auto& [id, record] : a->robots) {
    PlanRequest request;
    request.robot = id;
    request.max_edge_evaluations = 2000;
    const auto plan = (*strategy)->Plan(*a, request, NeverStop());
    const auto same = (*strategy)->Plan(*b, request, NeverStop());
    ASSERT_EQ(plan.ok(), same.ok()) << plan.status() << same.status();
    if (!plan.ok()) continue;
    EXPECT_EQ(plan->candidates, same->candidates);
    EXPECT_EQ(plan->trajectory, same->trajectory);
  }
}

// A mission of random events, and what is to hold of every state that can be saved on its way.
class Course {
 public:
  explicit Course(const MissionOptions& options) : options_(options) {
    mission_ = Mission::Create(options).value();
  }

  absl::StatusOr<Applied> Try(const EventBody& body) {
    auto applied = mission_->Apply(body);
    Step step{body, Outcome(applied), mission_->Digest(), ""};
    if (mission_->can_be_saved()) step.state = mission_->SaveState().value();
    steps_.push_back(std::move(step));
    return applied;
  }
  void Apply(const EventBody& body) { Try(body).IgnoreError(); }
  void ApplyRandom(std::uint64_t seed, int events, double width_m, double height_m) {
    RandomMission random(seed, width_m, height_m);
    for (const char* robot : {"a", "b"}) Apply(RobotRegistered{robot, 0.2, 0, 7});
    for (int i = 0; i < events; ++i) {
      const EventBody body = random.Next(*mission_);
      random.Learn(body, Try(body));
    }
  }

  // Restores every state; after every `stride`-th of them applies the rest of the events, under
  // sanitizers after a quarter of those.
  void ExpectAllRestored(std::size_t stride) const {
    if (support::kUnderSanitizer) stride *= 4;
    std::size_t states = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (steps_[i].state.empty()) continue;
      const auto restored = Mission::Restore(options_, steps_[i].state);
      ASSERT_TRUE(restored.ok()) << restored.status() << " after step " << i;
      ASSERT_EQ((*restored)->Digest(), steps_[i].digest) << "after step " << i;
      EXPECT_TRUE((*restored)->can_be_saved());
      EXPECT_EQ((*restored)->SaveState().value(), steps_[i].state);
      if (states++ % stride != 0) continue;
      for (std::size_t k = i + 1; k < steps_.size(); ++k) {
        ASSERT_EQ(Outcome((*restored)->Apply(steps_[k].body)), steps_[k].outcome) << k;
        ASSERT_EQ((*restored)->Digest(), steps_[k].digest)
            << "step " << k << " of kind " << steps_[k].body.index() << ", restored after " << i;
      }
      ExpectSameBeliefs(*mission_, **restored);
    }
    EXPECT_GT(states, steps_.size() / 20);
  }

  // What happened, so that a run is not green because it did nothing.
  std::int64_t epochs() const { return mission_->Snapshot()->gas_quality.epochs; }
  const std::vector<Step>& steps() const { return steps_; }
  Mission& mission() { return *mission_; }
  const MissionOptions& options() const { return options_; }

 private:
  MissionOptions options_;
  std::unique_ptr<Mission> mission_;
  std::vector<Step> steps_;
};

TEST(MissionState, RestoredMissionsGoOnTheSame) {
  for (int seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(absl::StrCat("seed ", seed));
    Course run{MissionOptions()};
    run.ApplyRandom(seed, 300, 5.0, 4.0);
    EXPECT_GT(run.epochs(), 1);
    run.ExpectAllRestored(20);
  }
}

TEST(MissionState, HoldsWhatPrecisionsWereLearned) {
  MissionOptions options;
  options.gas.precisions = GasPrecisions::kLearned;
  Course run(options);
  run.ApplyRandom(1, 300, 5.0, 4.0);
  EXPECT_GT(run.mission().Snapshot()->gas_quality.prior_precision_log_stddev, 0.0);
  run.ExpectAllRestored(20);
}

TEST(MissionState, ReadingsThatAgeDoSoAfterwards) {
  MissionOptions options = support::FastAgeing();
  options.gas.observation_stddev_share = 0.3;
  for (const double half_life_s : {60.0, 3.0}) {
    options.gas.ageing_half_life_s = half_life_s;
    Course run(options);
    run.ApplyRandom(11, 300, 4.0, 4.0);
    EXPECT_GT(run.epochs(), 3);
    run.ExpectAllRestored(20);
  }
}

TEST(MissionState, HoldsTheRegionOfTheField) {
  MissionOptions options;
  options.gas.field_reach_m = 1.0;
  options.gas.lattice_factor = 2;
  options.robot_silence_s = 5.0;
  Course run(options);
  run.ApplyRandom(21, 250, 20.0, 14.0);
  run.ExpectAllRestored(20);
}

TEST(MissionState, HoldsWhatBecameOfAKnownMap) {
  auto map =
      std::make_shared<Grid<CellState>>(GridGeometry{-1.0, 0.0, 0.1, 70, 60}, CellState::kFree);
  for (int x = 0; x < 70; ++x) (*map)[Cell{x, 30}] = CellState::kOccupied;
  for (const double reach_m : {25.0, 0.0, 2.0}) {
    MissionOptions options;
    options.gas.field_reach_m = reach_m;
    StartWith(map, options);
    Course run(options);
    run.Apply(PosteriorRefreshed{kSecond_ns});
    run.ApplyRandom(31, 150, 5.0, 5.0);
    run.ExpectAllRestored(20);
  }
}

TEST(MissionState, HoldsALatticeThatGrewCoarse) {
  MissionOptions options;
  options.memory_budget_bytes = std::int64_t{32} << 20;
  Course run(options);
  run.ApplyRandom(41, 200, 13.0, 12.0);
  EXPECT_GT(run.mission().lattice_factor(), 1);
  run.ExpectAllRestored(20);
}

// Which the events decide, whoever applies them.
TEST(MissionState, CanBeSavedWheneverAnEpochIsAdopted) {
  Course run(support::FastAgeing());
  run.Apply(RobotRegistered{"a", 0.2, 1, 3});
  int adopted = 0;
  for (const Observation& observation : support::RoomRun()) {
    run.Apply(ObservationReceived{"a", observation});
    Mission& mission = run.mission();
    if (mission.adoption_due()) {
      EXPECT_FALSE(mission.can_be_saved()) << "an epoch is under way";
      EXPECT_EQ(mission.SaveState().status().code(), absl::StatusCode::kFailedPrecondition);
      run.Apply(EpochAdopted{});
      EXPECT_TRUE(mission.can_be_saved());
      ++adopted;
    }
    if (mission.refresh_due()) run.Apply(PosteriorRefreshed{mission.sample_time_ns()});
    if (mission.epoch_due()) run.Apply(EpochBegun{mission.sample_time_ns()});
  }
  EXPECT_GT(adopted, 5);
  run.ExpectAllRestored(5);
}

// Bit by bit, although the live engine took another way to it than a fresh one.
TEST(MissionState, AReplayOfAnyPrefixHasItsDigest) {
  Course run(support::FastAgeing());
  run.ApplyRandom(51, 120, 4.0, 3.0);
  for (std::size_t prefix = 0; prefix <= run.steps().size(); prefix += 10) {
    const auto replay = Mission::Create(run.options()).value();
    for (std::size_t i = 0; i < prefix; ++i) {
      replay->Apply(run.steps()[i].body).IgnoreError();
      if (i % 7 == 0) replay->Snapshot();  // who looks on changes nothing
    }
    if (prefix > 0) {
      EXPECT_EQ(replay->Digest(), run.steps()[prefix - 1].digest);
    }
  }
}

TEST(MissionState, WhatAuditsFoundIsNoPartOfIt) {
  Course run{MissionOptions()};
  run.ApplyRandom(61, 40, 3.0, 3.0);
  const std::uint64_t digest = run.mission().Digest();
  run.mission().NoteAudits({.audits = 3, .mean_ppm = 1.0, .variance_ratio = 0.1, .alarms = 1});
  EXPECT_EQ(run.mission().Digest(), digest);
}

TEST(MissionState, OneThingThatDiffersShowsInTheDigest) {
  const Pose2 pose{1.0, 1.0, 0.0};
  const auto digest_of = [&](const RobotRegistered& robot, double radius_m, double reading_ppm,
                             std::int64_t reading_ns, ProgressOutcome outcome) {
    const auto mission = Mission::Create(MissionOptions()).value();
    Plan plan;
    plan.robot = "a";
    plan.candidates.emplace_back().goal.position = {2.0, 1.0};
    plan.chosen = 0;
    std::vector<EventBody> events = {robot};
    for (int k = 1; k <= 3; ++k) {
      events.push_back(ObservationReceived{
          "a", {k, kSecond_ns, pose, support::ScanInBox(pose, 3.0, 3.0, {{{2, 2}, radius_m}})}});
    }
    events.push_back(ObservationReceived{"a", {4, reading_ns, pose, GasReading{reading_ppm, 0.0}}});
    events.push_back(PosteriorRefreshed{2 * kSecond_ns});
    events.push_back(PlanIssued{plan});
    events.push_back(ProgressReported{"a", 1, outcome});
    for (const EventBody& event : events) EXPECT_TRUE(mission->Apply(event).ok());
    return mission->Digest();
  };
  const RobotRegistered robot{"a", 0.2, 5, 6};
  const ProgressOutcome reached = ProgressOutcome::kReached;
  const std::uint64_t same = digest_of(robot, 0.1, 3.0, kSecond_ns, reached);
  EXPECT_EQ(digest_of(robot, 0.1, 3.0, kSecond_ns, reached), same);
  EXPECT_NE(digest_of({"a", 0.3, 5, 6}, 0.1, 3.0, kSecond_ns, reached), same);
  EXPECT_NE(digest_of({"a", 0.2, 7, 6}, 0.1, 3.0, kSecond_ns, reached), same);
  EXPECT_NE(digest_of({"a", 0.2, 5, 8}, 0.1, 3.0, kSecond_ns, reached), same);
  EXPECT_NE(digest_of(robot, 0.3, 3.0, kSecond_ns, reached), same);
  EXPECT_NE(digest_of(robot, 0.1, std::nextafter(3.0, 4.0), kSecond_ns, reached), same);
  EXPECT_NE(digest_of(robot, 0.1, 3.0, kSecond_ns + 1, reached), same);
  EXPECT_NE(digest_of(robot, 0.1, 3.0, kSecond_ns, ProgressOutcome::kBlocked), same);
}

// A reading that waits, before there is any map; and nothing at all.
TEST(MissionState, CanBeSavedBeforeThereIsAField) {
  const auto live = Mission::Create(MissionOptions()).value();
  ASSERT_TRUE(live->Apply(RobotRegistered{"a", 0.2, 1, 2}).ok());
  for (int k = 1; k <= 5000; ++k) {  // more than are kept one by one
    const Pose2 pose{1.0 + 0.001 * k, 1.0, 0.0};
    ASSERT_TRUE(
        live->Apply(ObservationReceived{"a", {k, kSecond_ns, pose, GasReading{1.0, 0.0}}}).ok());
  }
  const auto restored = Mission::Restore(MissionOptions(), live->SaveState().value());
  ASSERT_TRUE(restored.ok()) << restored.status();
  const Pose2 pose{3.0, 1.0, 0.0};
  for (int k = 5001; k < 5010; ++k) {
    const ObservationReceived scan{"a", {k, kSecond_ns, pose, support::ScanInBox(pose, 6.0, 3.0)}};
    for (const EventBody& body : {EventBody(scan), EventBody(PosteriorRefreshed{k * kSecond_ns})}) {
      EXPECT_EQ((*restored)->Digest(), live->Digest());
      EXPECT_EQ(Outcome((*restored)->Apply(body)), Outcome(live->Apply(body)));
    }
  }
  EXPECT_EQ((*restored)->Digest(), live->Digest());
  EXPECT_GT(live->Snapshot()->gas_counters.in_posterior, 4900);
  ExpectSameBeliefs(*live, **restored);
}

TEST(MissionState, AFieldThatFailedIsMadeAnewAfterwardsToo) {
  if (GasMapPeer::kStopsAtDefects) return;
  Course run{MissionOptions()};
  run.ApplyRandom(71, 60, 3.0, 3.0);
  Mission& mission = run.mission();
  ASSERT_TRUE(run.Try(RobotRegistered{"a", 0.2, 1'000'000, 7}).ok());
  run.Apply(PosteriorRefreshed{mission.sample_time_ns()});
  run.Apply(EpochBegun{mission.sample_time_ns()});
  GasMapPeer::LosePrior(MissionPeer::Gas(mission));
  const Pose2 pose{1.0, 1.0, 0.0};
  for (int k = 0; k < 3; ++k) {
    run.Apply(
        ObservationReceived{"a",
                            {mission.AppliedSequence("a").value_or(0) + 1, mission.sample_time_ns(),
                             pose, support::ScanInBox(pose, 60.0, 60.0)}});
  }
  const std::size_t failed = run.steps().size();
  run.Apply(PosteriorRefreshed{mission.sample_time_ns()});
  ASSERT_TRUE(mission.posterior_stale());
  ASSERT_TRUE(mission.can_be_saved());
  GasMapPeer::FindPrior(MissionPeer::Gas(mission));
  run.Apply(PosteriorRefreshed{mission.sample_time_ns()});
  ASSERT_FALSE(mission.posterior_stale());

  const auto restored = Mission::Restore(run.options(), run.steps()[failed].state);
  ASSERT_TRUE(restored.ok()) << restored.status();
  EXPECT_EQ((*restored)->Digest(), run.steps()[failed].digest);
  EXPECT_EQ(Outcome((*restored)->Apply(run.steps().back().body)), run.steps().back().outcome);
  EXPECT_EQ((*restored)->Digest(), run.steps().back().digest);
}

TEST(MissionState, AnAbandonedMissionIsNotSaved) {
  Course run{MissionOptions()};
  run.ApplyRandom(81, 40, 3.0, 3.0);
  ASSERT_TRUE(run.Try(RobotRegistered{"a", 0.2, 1'000'000, 7}).ok());
  run.Apply(PosteriorRefreshed{run.mission().sample_time_ns()});
  run.Apply(EpochBegun{run.mission().sample_time_ns()});
  run.Apply(EpochAdopted{});
  ASSERT_TRUE(run.mission().can_be_saved());
  const std::string state = run.mission().SaveState().value();
  const auto stopped = Mission::Restore(run.options(), state, [] { return true; });
  EXPECT_EQ(stopped.status().code(), absl::StatusCode::kCancelled);

  ASSERT_TRUE(run.mission().Apply(EpochBegun{run.mission().sample_time_ns()}).ok());
  run.mission().AbandonWhen([] { return true; });
  const auto begun = run.mission().Apply(EpochBegun{run.mission().sample_time_ns()});
  EXPECT_FALSE(begun.ok());
  const Pose2 pose{1.0, 1.0, 0.0};
  for (int k = 0; k < 3; ++k) {
    run.mission()
        .Apply(ObservationReceived{
            "a",
            {run.mission().AppliedSequence("a").value_or(0) + 1, run.mission().sample_time_ns(),
             pose, support::ScanInBox(pose, 60.0, 60.0)}})
        .IgnoreError();
  }
  const auto refreshed = run.mission().Apply(PosteriorRefreshed{run.mission().sample_time_ns()});
  EXPECT_EQ(refreshed.status().code(), absl::StatusCode::kCancelled);
  EXPECT_FALSE(run.mission().can_be_saved());
}

}  // namespace mission_state_test
}  // namespace plumescout
