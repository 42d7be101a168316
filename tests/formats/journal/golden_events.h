// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/types/event.h"
#include "formats/journal/event_codec.h"

namespace plumescout::support {

// What every file of tests/formats/journal/golden holds: a mission that can be replayed, with
// events of every kind and another value in every field. It stays as it is, for the files do; what
// a new version adds comes last.

inline constexpr std::int64_t kGoldenSeed = 42;

inline JournalStart GoldenStart() {
  JournalStart start;
  start.code_version = "0.1.0";
  start.mission_options = "\x50\x2A";  // plumescout.v1.MissionOptions{.seed = 42}
  start.mission = "hall";
  start.owner = "operator";
  start.tenant = "plant";
  start.created_ns = 1'700'000'000'123'456'789;
  return start;
}

// A robot in a room looks about, eight beams at a time.
inline std::vector<Scan> GoldenScans() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const Scan in_centimetres = {
      -3.0, 0.75, 8.0, {1.23F, 2.5F, kInfinity, 3.01F, kNaN, 3.02F, 0.07F, 2.99F}};
  Scan in_tenths = in_centimetres;
  in_tenths.ranges_m = {1.2301F, 2.5004F, 2.5003F, 3.0F, 7.9999F, 3.0205F, 0.0701F, 2.9902F};
  Scan in_no_unit = in_centimetres;
  in_no_unit.ranges_m = {1.2345678F, 2.7182818F, kInfinity,  3.1415927F,
                         kNaN,       3.0166206F, 0.0707107F, 2.9957323F};
  return {in_centimetres, in_tenths, in_no_unit};
}

inline Goal GoldenGoal(GoalKind kind, double x_m) {
  return {kind, {12, -7}, {x_m, -0.65}, {x_m + 0.125, -0.7}, 9};
}

inline Plan GoldenPlan() {
  Candidate far;
  far.goal = GoldenGoal(GoalKind::kOccupancyFrontier, 2.25);
  far.path = {{0.5, -0.5}, {2.25, -0.65}};
  Candidate near;
  near.goal = GoldenGoal(GoalKind::kInformation, 1.25);
  near.path = {{0.5, -0.5}, {0.9, -0.6}, {1.25, -0.65}};
  near.path_source = PathSource::kGridGuard;
  near.cost = 11.5;
  near.information_penalty = 2.75;
  near.length_m = 0.8;
  near.mean_ucb = 0.375;
  near.mean_concentration_ppm = 4.5;
  near.duration_s = 0.64;
  near.expected_information_nats = 1.5;
  near.reward = 0.25;
  near.stops = {{0.9, -0.6}, {1.25, -0.65}};
  Plan plan;
  plan.robot = "r1";
  plan.strategy = "plumescout";
  plan.belief_revision = 6;
  plan.seed = 0xFEDC'BA98'7654'3210;
  plan.phase = MissionPhase::kGasProbing;
  plan.end = PlanEnd::kQueueExhausted;
  plan.chosen = 1;
  plan.candidates = {far, near};
  plan.rejected = {{GoldenGoal(GoalKind::kGasFrontier, 3.25), RejectionReason::kSetAside, "till 8"},
                   {GoldenGoal(GoalKind::kSite, 4.25), RejectionReason::kGone, ""}};
  plan.trajectory.waypoints = {{{0.5, -0.5, 0.25}, 0.0, 0.0, 1.25},
                               {{0.9, -0.6, -0.125}, 0.33, 0.5, 0.75},
                               {{1.25, -0.65, -0.25}, 1.14, 0.0, 0.0}};
  plan.trajectory.length_m = 0.8125;
  plan.trajectory.duration_s = 1.14;
  plan.effort = {300, 251, 1234, 1, 2};
  plan.field_flat = true;
  plan.goal_kept = false;
  plan.start_escaped = true;
  plan.explanation = "Most information per second: 2.3 nats/s, 0.8 m away.";
  return plan;
}

inline std::vector<Event> GoldenEvents() {
  constexpr std::int64_t kStart_ns = 1'700'000'001'000'000'000;
  constexpr std::int64_t kPeriod_ns = 100'000'000;
  const Pose2 pose = {0.5, -0.5, 0.25};
  std::vector<Event> events;
  const auto add = [&events](EventBody body) {
    events.push_back({static_cast<std::int64_t>(events.size()) + 1, std::move(body)});
  };
  RobotRegistered registered;
  registered.robot = "r1";
  registered.radius_m = 0.25;
  registered.lease_token = 4'294'967'297;
  registered.log_epoch = 0x0011'2233'4455'6677;
  add(registered);
  std::int64_t sequence = 0;
  const auto observe = [&](auto payload) {
    ++sequence;
    add(ObservationReceived{"r1", {sequence, kStart_ns + sequence * kPeriod_ns, pose, payload}});
  };
  for (const Scan& scan : GoldenScans()) observe(scan);
  observe(GasReading{17.5, 0.0625});
  observe(SequenceGap{5, 9});
  add(PosteriorRefreshed{kStart_ns + 6 * kPeriod_ns});
  add(PlanIssued{GoldenPlan()});
  add(ProgressReported{"r1", 1, ProgressOutcome::kBlocked});
  add(EpochBegun{kStart_ns + 7 * kPeriod_ns});
  add(EpochAdopted{});
  Plan stay;
  stay.robot = "r1";
  stay.belief_revision = 11;
  stay.phase = MissionPhase::kComplete;
  stay.end = PlanEnd::kMissionComplete;
  add(PlanIssued{stay});
  add(RobotRemoved{"r1"});
  return events;
}

}  // namespace plumescout::support
