// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "core/types/ids.h"
#include "core/types/rng.h"
#include "core/types/species.h"
#include "tests/core/mission/random_robots.h"

namespace plumescout {

// Draws events of every kind for a mission of three robots in an empty room: mostly what should be,
// and at times what should not.
class EventfulMission {
 public:
  EventfulMission(std::uint64_t seed, double width_m, double height_m)
      : rng_(seed), robots_(rng_, width_m, height_m) {}
  EventfulMission(const EventfulMission&) = delete;
  EventfulMission& operator=(const EventfulMission&) = delete;

  EventBody Next(const Mission& mission) {
    if (mission.rebuilt_map_due() && rng_.Below(3) == 0) return MapRebuilt{};
    if (mission.rebuild_due() && rng_.Below(4) == 0) return MapRebuildBegun{};
    if (mission.adoption_due() && rng_.Below(4) != 0) return EpochAdopted{};
    if (mission.epoch_due() && rng_.Below(4) != 0) return EpochBegun{Now_ns()};
    const RobotId robot = AnyRobot();
    const auto known = mission.StateOf(robot);
    const bool may_join =
        !known.ok() ? rng_.Below(3) == 0 : known->frame_suspect && rng_.Below(6) == 0;
    if (may_join) return Join(mission, robot);
    switch (rng_.Below(24)) {
      case 0:
        if (rng_.Below(3) != 0) return Join(mission, robot);
        return RobotRemoved{rng_.Below(4) == 0 ? "d" : robot};
      case 1:
      case 2:
        return MakePlan(mission, robot);
      case 3:
      case 4:
        return MakeReport(robot);
      case 5:
        return rng_.Below(2) == 0 ? EventBody(EpochBegun{Now_ns()}) : EpochAdopted{};
      case 6:
      case 7:
        return PosteriorRefreshed{Now_ns()};
      case 8:
      case 9:
        return Order(mission, rng_.Below(5) == 0 ? "d" : robot);
      case 10:
        robots_.Pass(static_cast<std::int64_t>(rng_.Below(40)) * kSecond_ns);  // others fall silent
        [[fallthrough]];
      default:
        return ObservationReceived{robot, robots_.Next(mission, robot)};
    }
  }

  // What came of it.
  void Learn(const EventBody& body, const absl::StatusOr<Applied>& applied) {
    if (!applied.ok()) return;
    if (const auto* const issued = std::get_if<PlanIssued>(&body)) {
      plans_[issued->plan.robot] = applied->plan_id;
    } else if (const auto* const registered = std::get_if<RobotRegistered>(&body)) {
      robots_.HasSensors(registered->robot, registered->sensors.size());
    }
  }

 private:
  static constexpr std::int64_t kSecond_ns = 1'000'000'000;

  RobotId AnyRobot() { return std::string(1, static_cast<char>('a' + rng_.Below(3))); }
  std::int64_t Now_ns() { return rng_.Below(12) == 0 ? -1 : robots_.now_ns(); }

  // With a new lease, and mostly with the frame that it has.
  EventBody Join(const Mission& mission, const RobotId& robot) {
    RobotRegistered joining{robot, 0.2, ++lease_token_, 1 + static_cast<std::int64_t>(robot[0])};
    if (rng_.Below(15) == 0) joining.robot = "d";
    const auto known = mission.StateOf(robot);
    if (known.ok() && rng_.Below(4) != 0) {
      joining.frame = known->frame;
    } else if (robot != "a") {
      joining.frame = {{rng_.Uniform(-5.0, 5.0), rng_.Uniform(-5.0, 5.0), rng_.Uniform(-3.0, 3.0)},
                       rng_.Uniform01(),
                       0.1};
    }
    for (std::uint64_t i = rng_.Below(4); i > 0; --i) {
      joining.sensors.push_back(MakeSensor(mission, joining.sensors.size()));
    }
    switch (rng_.Below(8)) {
      case 0:
        joining.lease_token = 0;
        break;
      case 1:
        joining.log_epoch = kLogEpochEnd;
        break;
      case 2:
        joining.frame.position_stddev_m = -1.0;
        break;
      case 3:
        joining.sensors.resize(2, {"same", {}});
        joining.sensors[0] = joining.sensors[1];
        break;
      default:
        break;
    }
    return joining;
  }
  GasSensor MakeSensor(const Mission& mission, std::size_t place) {
    GasSensor sensor{absl::StrCat("s", place), {rng_.Uniform(-0.2, 0.2), rng_.Uniform(-0.2, 0.2)}};
    if (rng_.Below(2) == 0) sensor.stddev_ppm = rng_.Uniform(0.1, 2.0);
    const MissionOptions& options = mission.options();
    const bool may_have_offset =
        options.gas.scale == GasScale::kLinear && options.gas.ageing_half_life_s == 0.0;
    const std::uint64_t kind = rng_.Below(may_have_offset || rng_.Below(10) == 0 ? 3 : 2);
    if (kind == 1) sensor.response_time_s = rng_.Uniform(0.5, 5.0);
    if (kind == 2) sensor.offset_stddev_ppm = rng_.Uniform(0.5, 5.0);
    sensor.species = SpeciesName(options, rng_.Below(SpeciesCount(options)));
    if (rng_.Below(40) == 0) sensor.species = "radon";
    return sensor;
  }

  // What operators and servers say.
  EventBody Order(const Mission& mission, const RobotId& robot) {
    switch (rng_.Below(12)) {
      case 0:
      case 1:
        return ClockOffsetNoted{
            robot, static_cast<std::int64_t>(rng_.Below(7)) * kSecond_ns - 3 * kSecond_ns};
      case 2:
        return ClockOffsetNoted{
            robot, rng_.Below(2) == 0 ? std::numeric_limits<std::int64_t>::min() : kSecond_ns};
      case 3:
      case 4:
        return HomeOrdered{robot, rng_.Below(3) != 0};
      case 5:
      case 6:
        return MapRebuildBegun{};
      case 7:
        return MapRebuilt{};
      default:
        return ChangeAreas(mission);
    }
  }
  KeepOutChanged ChangeAreas(const Mission& mission) {
    constexpr double kFar_m = 100.0;
    const Polygon all{{{-kFar_m, -kFar_m}, {kFar_m, -kFar_m}, {0.0, kFar_m}}, "all"};
    if (rng_.Below(5) == 0) return {{}, {all}};
    KeepOutChanged change;
    const std::vector<Polygon>& areas = mission.options().keep_out;
    if (!areas.empty() && rng_.Below(3) == 0) change.deleted.push_back(areas.front().name);
    if (rng_.Below(4) == 0) change.deleted.push_back("elsewhere");
    for (std::uint64_t i = rng_.Below(3); i > 0; --i) {
      const Point2 place = robots_.Place();
      change.added.push_back({{place, {place.x_m + 0.7, place.y_m}, {place.x_m, place.y_m + 0.7}},
                              absl::StrCat("k", rng_.Below(2))});
    }
    if (!areas.empty() && rng_.Below(4) == 0) change.added = {areas.back()};
    if (rng_.Below(6) == 0) change.added.push_back({{{0.0, 0.0}}, "no-area"});
    return change;
  }

  EventBody MakePlan(const Mission& mission, const RobotId& robot) {
    Plan plan;
    plan.robot = robot;
    plan.belief_revision = mission.revision() + (rng_.Below(20) == 0 ? 1 : 0);
    plan.phase = static_cast<MissionPhase>(rng_.Below(7));
    if (rng_.Below(3) == 0) {
      plan.rejected.push_back({MakeGoal(), static_cast<RejectionReason>(rng_.Below(12)), "why"});
    }
    if (rng_.Below(5) != 0) {
      Candidate& candidate = plan.candidates.emplace_back();
      candidate.goal = MakeGoal();
      plan.chosen = rng_.Below(20) == 0 ? 1 : 0;
      const Pose2 from = mission.StateOf(robot).value_or(RobotState()).pose;
      const Point2 to = candidate.goal.position;
      plan.trajectory.waypoints = {{from, 0.0, 0.0, 0.0}, {{to.x_m, to.y_m, 0.0}, 3.0, 0.0, 0.0}};
      plan.trajectory.length_m = Distance_m(from.position(), to);
      plan.trajectory.duration_s = rng_.Uniform(1.0, 20.0);
    }
    return PlanIssued{plan, rng_.Below(3) == 0};
  }
  // Often the same one, which another robot may have claimed.
  Goal MakeGoal() {
    Goal goal;
    const bool is_usual = rng_.Below(2) == 0;
    goal.kind = is_usual ? GoalKind::kSite : static_cast<GoalKind>(rng_.Below(7));
    goal.position = is_usual ? Point2{1.0, 1.0} : robots_.Place();
    goal.centroid = goal.position;
    return goal;
  }

  // Mostly of the robot's latest plan.
  EventBody MakeReport(const RobotId& robot) {
    const PlanId plan = plans_[robot] + (rng_.Below(10) == 0 ? 1 : 0);
    return ProgressReported{robot, plan, static_cast<ProgressOutcome>(rng_.Below(3))};
  }

  Rng rng_;
  RandomRobots robots_;
  std::int64_t lease_token_ = 0;
  std::map<RobotId, PlanId> plans_;  // the latest of each
};

}  // namespace plumescout
