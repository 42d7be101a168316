// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/mission/mission.h"
#include "core/types/observation.h"
#include "core/types/rng.h"
#include "core/types/robot_frame.h"
#include "tests/support/box_room.h"

namespace plumescout {

// Robots that drive about in an empty room, and what they tell of it: what they see and read, and
// at times what makes no sense. Now and then one loses its place, and later finds it again, whether
// it says so or not.
class RandomRobots {
 public:
  RandomRobots(Rng& rng, double width_m, double height_m)
      : rng_(rng), width_m_(width_m), height_m_(height_m) {}

  std::int64_t now_ns() const { return now_ns_; }
  void Pass(std::int64_t time_ns) { now_ns_ += time_ns; }
  Point2 Place() { return {HalfMetres(width_m_), HalfMetres(height_m_)}; }
  // It registered with so many.
  void HasSensors(const RobotId& robot, std::size_t count) { Of(robot).sensors = count; }

  // The next of the robot's log; rarely one that is there already, or is not the next.
  Observation Next(const Mission& mission, const RobotId& robot) {
    now_ns_ += static_cast<std::int64_t>(rng_.Below(400'000'000));
    Robot& teller = Of(robot);
    Drive(teller);
    const RobotState known = mission.StateOf(robot).value_or(RobotState());
    Observation observation;
    observation.sequence = known.applied_sequence + 1;
    if (rng_.Below(30) == 0) observation.sequence += rng_.Below(2) == 0 ? -1 : 2;
    observation.sample_time_ns = now_ns_ - known.clock_offset_ns;
    if (rng_.Below(30) == 0) observation.sample_time_ns -= kSecond_ns;
    observation.pose = InRobot(known.frame, Told(teller));
    FillIn(teller, known.frame, observation);
    if (rng_.Below(12) == 0) Spoil(observation);
    teller.way.push_back({observation.sample_time_ns, teller.truth});
    if (teller.way.size() > kLongestWay) teller.way.erase(teller.way.begin());
    return observation;
  }

 private:
  static constexpr std::int64_t kSecond_ns = 1'000'000'000;
  static constexpr std::size_t kLongestWay = 12;

  struct Robot {
    Pose2 truth;
    Point2 error;                 // of where it holds itself to be
    std::vector<PoseAnchor> way;  // where it was, in frame map, by its own clock
    std::size_t sensors = 0;
  };

  Robot& Of(const RobotId& robot) {
    const auto [found, is_new] = robots_.try_emplace(robot);
    const Point2 place = is_new ? Place() : Point2();
    if (is_new) found->second.truth = {place.x_m, place.y_m, 0.0};
    return found->second;
  }
  double HalfMetres(double size_m) {
    const auto places = static_cast<std::uint64_t>(2.0 * size_m) - 1;
    return 0.5 * (1.0 + static_cast<double>(rng_.Below(places)));
  }
  // A step of up to 1.5 m, in half metres; the room's middle is as far from walls as can be.
  double Step(double from_m, double size_m) {
    const double step_m = 0.5 * static_cast<double>(rng_.Below(7)) - 1.5;
    return std::clamp(from_m + step_m, 0.5, size_m - 0.5);
  }
  void Drive(Robot& robot) {
    Pose2& truth = robot.truth;
    truth = {Step(truth.x_m, width_m_), Step(truth.y_m, height_m_), rng_.Uniform(-3.0, 3.0)};
    const bool is_lost = robot.error != Point2();
    if (!is_lost && rng_.Below(25) == 0) {
      const double jump_m = rng_.Uniform(2.0, 2.5);
      robot.error = {2.0 * truth.x_m < width_m_ ? jump_m : -jump_m, 0.0};
    } else if (is_lost && rng_.Below(30) == 0) {
      robot.error = {};
    }
  }
  static Pose2 Told(const Robot& robot) {
    return {robot.truth.x_m + robot.error.x_m, robot.truth.y_m + robot.error.y_m,
            robot.truth.yaw_rad};
  }

  void FillIn(Robot& robot, const RobotFrame& frame, Observation& observation) {
    const bool is_lost = robot.error != Point2();
    const std::uint64_t draw = rng_.Below(30);
    if (draw < 15) {
      observation.payload = Seen(robot.truth);
    } else if (draw < 26) {
      observation.pose.x_m += rng_.Uniform(-0.8, 0.8);  // in the room, in its walls and beyond
      observation.pose.y_m += rng_.Uniform(-0.8, 0.8);
      observation.payload = Read(robot);
    } else if (draw == 26 || (draw == 27 && is_lost)) {
      observation.payload = Corrected(robot, frame);
      robot.error = {};
      observation.pose = InRobot(frame, robot.truth);
    } else if (draw == 27) {
      observation.payload = SequenceGap{
          observation.sequence, observation.sequence + static_cast<std::int64_t>(rng_.Below(3))};
      if (rng_.Below(2) == 0) observation.pose = {};
    } else {
      observation.payload = RobotStatus{rng_.Below(3) == 0 ? 0.1 : rng_.Uniform01()};
      if (rng_.Below(2) == 0) observation.pose = {};
    }
  }
  Scan Seen(const Pose2& pose) {
    Scan scan =
        support::ScanInBox(pose, width_m_, height_m_, {{{1.7, 1.3}, rng_.Uniform(0.1, 0.4)}});
    if (rng_.Below(4) == 0) {
      scan.ranges_m[rng_.Below(scan.ranges_m.size())] = std::numeric_limits<float>::quiet_NaN();
    }
    return scan;
  }
  GasReading Read(const Robot& robot) {
    const bool has_variance = rng_.Below(4) == 0;
    return {rng_.Uniform(0.0, 50.0), has_variance ? rng_.Uniform(0.01, 3.0) : 0.0,
            static_cast<int>(rng_.Below(std::max<std::uint64_t>(1, robot.sensors)))};
  }
  // Of some of the moments that are remembered, and mostly of the last one.
  PoseCorrection Corrected(const Robot& robot, const RobotFrame& frame) {
    std::map<std::int64_t, Pose2> anchors;
    for (std::size_t i = 0; i < robot.way.size(); ++i) {
      const bool is_last = i + 1 == robot.way.size();
      if (rng_.Below(4) != (is_last ? 3 : 0) && !is_last) continue;
      anchors[robot.way[i].sample_time_ns] = InRobot(frame, robot.way[i].pose);
    }
    PoseCorrection correction;
    for (const auto& [time_ns, pose] : anchors) correction.anchors.push_back({time_ns, pose});
    return correction;
  }

  // What the mission refuses, but for the last ones, which may do.
  void Spoil(Observation& observation) {
    constexpr std::int64_t kLeap_ns = 172'800 * kSecond_ns;  // two days
    switch (rng_.Below(15)) {
      case 0:
        observation.pose.x_m = 1e6;
        return;
      case 1:
        observation.sample_time_ns = -1;
        return;
      case 2:
        observation.sample_time_ns += kLeap_ns;
        return;
      case 3:
        observation.payload = Scan{0.0, 0.1, 8.0, {}};
        return;
      case 4:
        observation.payload = Scan{0.0, 0.1, 1e6, {1.0F}};
        return;
      case 5:
        observation.payload = GasReading{-1.0, 0.0};
        return;
      case 6:
        observation.payload = GasReading{1.0, 1e-12};
        return;
      case 7:
        observation.payload = GasReading{1.0, 0.0, 7};
        return;
      case 8:
        observation.payload = RobotStatus{1.5};
        return;
      case 9:
        observation.payload = PoseCorrection{};
        return;
      case 10:
        observation.payload = PoseCorrection{{{5, {}}, {5, {}}}};
        return;
      case 11:
        observation.payload = PoseCorrection{{{observation.sample_time_ns + 1, {}}}};
        return;
      default:
        observation.payload = SequenceGap{observation.sequence + 1, observation.sequence};
    }
  }

  Rng& rng_;
  double width_m_;
  double height_m_;
  std::int64_t now_ns_ = 10 * kSecond_ns;
  std::map<RobotId, Robot> robots_;
};

}  // namespace plumescout
