// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "absl/status/statusor.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "core/types/rng.h"
#include "tests/support/box_room.h"

namespace plumescout {

// Draws events of a mission in an empty room: mostly what robots do, and at times what they should
// not.
class RandomMission {
 public:
  RandomMission(std::uint64_t seed, double width_m, double height_m)
      : rng_(seed), width_m_(width_m), height_m_(height_m) {}

  EventBody Next(const Mission& mission) {
    if (mission.adoption_due() && rng_.Below(4) != 0) return EpochAdopted{};
    if (mission.epoch_due() && rng_.Below(4) != 0) return EpochBegun{now_ns_};
    switch (rng_.Below(24)) {
      case 0:
        return RobotRegistered{AnyRobot(), 0.2, ++lease_token_, Int64()};
      case 1:
        return rng_.Below(6) == 0 ? EventBody(RobotRemoved{AnyRobot()}) : Observe(mission, Seen());
      case 2:
      case 3:
        return MakePlan(mission);
      case 4:
      case 5:
        return MakeReport();
      case 6:
        return EpochBegun{now_ns_};
      case 7:
        return EpochAdopted{};
      case 8:
      case 9:
      case 10:
        return PosteriorRefreshed{now_ns_};
      case 11:
        return Observe(mission, SequenceGap{});
      case 12:
        now_ns_ += static_cast<std::int64_t>(rng_.Below(40)) * kSecond_ns;  // others fall silent
        return Observe(mission, Seen());
      case 13:
      case 14:
      case 15:
      case 16:
        return Observe(mission, Seen());
      default:
        return Observe(mission, Read());
    }
  }

  // What came of it.
  void Learn(const EventBody& body, const absl::StatusOr<Applied>& applied) {
    const auto* const issued = std::get_if<PlanIssued>(&body);
    if (issued != nullptr && applied.ok()) plans_[issued->plan.robot] = applied->plan_id;
  }

 private:
  static constexpr std::int64_t kSecond_ns = 1'000'000'000;

  std::int64_t Int64() { return static_cast<std::int64_t>(rng_.Next()); }
  RobotId AnyRobot() { return std::string(1, static_cast<char>('a' + rng_.Below(3))); }
  Point2 Place() {
    const auto half_metres = [&](double size_m) {
      const auto places = static_cast<std::uint64_t>(2.0 * size_m) - 1;
      return 0.5 * (1.0 + static_cast<double>(rng_.Below(places)));
    };
    return {half_metres(width_m_), half_metres(height_m_)};
  }
  Scan Seen() {
    return support::ScanInBox(pose_, width_m_, height_m_, {{{1.7, 1.3}, rng_.Uniform(0.1, 0.4)}});
  }
  GasReading Read() {
    if (rng_.Below(20) == 0) return {-1.0, 0.0};  // is refused
    return {rng_.Uniform(0.0, 50.0), rng_.Below(4) == 0 ? rng_.Uniform(0.01, 3.0) : 0.0};
  }

  // The next of some robot's log; at the next draw the robot is elsewhere.
  template <typename Payload>
  EventBody Observe(const Mission& mission, Payload payload) {
    Observation observation;
    const RobotId robot = AnyRobot();
    now_ns_ += static_cast<std::int64_t>(rng_.Below(400'000'000));
    observation.sequence = mission.AppliedSequence(robot).value_or(0) + 1;
    observation.sample_time_ns = now_ns_;
    observation.pose = pose_;
    if constexpr (std::is_same_v<Payload, GasReading>) {
      // In the room, in its walls and beyond.
      observation.pose.x_m = rng_.Uniform(-0.3, width_m_ + 0.3);
      observation.pose.y_m = rng_.Uniform(-0.3, height_m_ + 0.3);
    }
    if constexpr (std::is_same_v<Payload, SequenceGap>) {
      payload = {observation.sequence, observation.sequence + 2};
    }
    observation.payload = std::move(payload);
    const Point2 place = Place();
    pose_ = {place.x_m, place.y_m, rng_.Uniform(-3.0, 3.0)};
    return ObservationReceived{robot, observation};
  }

  EventBody MakePlan(const Mission& mission) {
    Plan plan;
    plan.robot = AnyRobot();
    plan.belief_revision = mission.revision();
    plan.phase = static_cast<MissionPhase>(rng_.Below(7));
    if (rng_.Below(5) != 0) {
      Candidate& candidate = plan.candidates.emplace_back();
      candidate.goal.kind = static_cast<GoalKind>(rng_.Below(6));
      candidate.goal.position = rng_.Below(2) == 0 ? Point2{1.0, 1.0} : Place();
      candidate.goal.centroid = candidate.goal.position;
      plan.chosen = 0;
      plan.trajectory.waypoints = {{pose_, 0.0, 0.0, 0.0},
                                   {{candidate.goal.position.x_m, 1.0, 0.0}, 3.0, 0.0, 0.0}};
      plan.trajectory.length_m = 2.0;
      plan.trajectory.duration_s = rng_.Uniform(1.0, 20.0);
    }
    return PlanIssued{plan};
  }

  // Mostly of the robot's latest plan.
  EventBody MakeReport() {
    const RobotId robot = AnyRobot();
    const PlanId plan = plans_[robot] + (rng_.Below(10) == 0 ? 1 : 0);
    return ProgressReported{robot, plan, static_cast<ProgressOutcome>(rng_.Below(3))};
  }

  Rng rng_;
  double width_m_;
  double height_m_;
  std::int64_t now_ns_ = kSecond_ns;
  std::int64_t lease_token_ = 0;
  Pose2 pose_{1.0, 1.0, 0.0};
  std::map<RobotId, PlanId> plans_;  // the latest of each
};

}  // namespace plumescout
