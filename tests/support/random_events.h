// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/types/event.h"
#include "core/types/rng.h"

namespace plumescout {

// Draws events of every kind with numbers of every bit pattern (infinities and NaN among them),
// texts of every byte and lists of 0 to 3 elements.
class RandomEvents {
 public:
  explicit RandomEvents(std::uint64_t seed) : rng_(seed) {}

  Event Next() {
    Event event;
    event.number = Int64();
    switch (rng_.Below(std::variant_size_v<decltype(event.body)>)) {
      case 0:
        event.body = MakeRegistration();
        break;
      case 1:
        event.body = ObservationReceived{Text(), MakeObservation()};
        break;
      case 2:
        event.body = PosteriorRefreshed{Int64()};
        break;
      case 3:
        event.body = PlanIssued{MakePlan(), Bool()};
        break;
      case 4:
        event.body = ProgressReported{Text(), Int64(), Choice<ProgressOutcome>(3)};
        break;
      case 5:
        event.body = EpochBegun{Int64()};
        break;
      case 6:
        event.body = EpochAdopted{};
        break;
      case 7:
        event.body = RobotRemoved{Text()};
        break;
      case 8:
        event.body = ClockOffsetNoted{Text(), Int64()};
        break;
      case 9:
        event.body = HomeOrdered{Text(), Bool()};
        break;
      case 10:
        event.body = MapRebuildBegun{};
        break;
      case 11:
        event.body = MapRebuilt{};
        break;
      default:
        event.body = MakeKeepOut();
    }
    return event;
  }

 private:
  std::int64_t Int64() { return static_cast<std::int64_t>(rng_.Next()); }
  int Int() { return static_cast<int>(static_cast<std::int32_t>(rng_.Next())); }
  bool Bool() { return rng_.Below(2) == 1; }
  template <typename T>
  T Choice(std::uint64_t count) {
    return static_cast<T>(rng_.Below(count));
  }
  double Real() {
    const std::uint64_t bits = rng_.Next();
    double value;
    static_assert(sizeof(value) == sizeof(bits));
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  float Float() {
    const auto bits = static_cast<std::uint32_t>(rng_.Next());
    float value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  std::string Text() {
    std::string text(rng_.Below(20), '\0');
    for (char& c : text) c = static_cast<char>(rng_.Below(256));
    return text;
  }
  template <typename Make>
  auto List(Make make) {
    std::vector<decltype(make())> list;
    const std::uint64_t size = rng_.Below(4);
    for (std::uint64_t i = 0; i < size; ++i) list.push_back(make());
    return list;
  }
  Point2 MakePoint() { return {Real(), Real()}; }
  Polygon MakeArea() {
    return {List([this] { return MakePoint(); }), Text()};
  }
  KeepOutChanged MakeKeepOut() {
    return {List([this] { return Text(); }), List([this] { return MakeArea(); })};
  }
  Pose2 MakePose() { return {Real(), Real(), Real()}; }
  // Every other one is that of a robot that gives none.
  RobotFrame MakeFrame() { return Bool() ? RobotFrame() : RobotFrame{MakePose(), Real(), Real()}; }
  RobotRegistered MakeRegistration() {
    return {Text(), Real(), Int64(), Int64(), MakeFrame(), List([this] { return MakeSensor(); })};
  }
  GasSensor MakeSensor() { return {Text(), MakePoint(), Real(), Real(), Text(), Real()}; }
  Observation MakeObservation() {
    Observation observation{Int64(), Int64(), MakePose(), {}};
    switch (rng_.Below(5)) {
      case 0:
        observation.payload = Scan{Real(), Real(), Real(), List([this] { return Float(); })};
        break;
      case 1:
        observation.payload = GasReading{Real(), Real(), Bool() ? 0 : Int()};
        break;
      case 2:
        observation.payload = PoseCorrection{List([this] {
          return PoseAnchor{Int64(), MakePose()};
        })};
        break;
      case 3:
        observation.payload = RobotStatus{Real()};
        break;
      default:
        observation.payload = SequenceGap{Int64(), Int64()};
    }
    return observation;
  }
  Goal MakeGoal() { return {Choice<GoalKind>(7), {Int(), Int()}, MakePoint(), MakePoint(), Int()}; }
  Candidate MakeCandidate() {
    return {MakeGoal(),
            List([this] { return MakePoint(); }),
            Choice<PathSource>(3),
            Real(),
            Real(),
            Real(),
            Real(),
            Real(),
            Real(),
            Bool() ? std::optional<double>(Real()) : std::nullopt,
            std::nullopt,  // events do not keep bounds
            1.0,           // nor what others are to see
            Bool() ? std::optional<double>(Real()) : std::nullopt,
            List([this] { return MakePoint(); })};
  }
  Plan MakePlan() {
    Plan plan;
    plan.id = Int64();
    plan.robot = Text();
    plan.strategy = Text();
    plan.belief_revision = Int64();
    plan.seed = rng_.Next();
    plan.phase = Choice<MissionPhase>(7);
    plan.end = Choice<PlanEnd>(7);
    plan.chosen = Int();
    plan.candidates = List([this] { return MakeCandidate(); });
    plan.rejected = List([this] {
      return RejectedGoal{MakeGoal(), Choice<RejectionReason>(12), Text()};
    });
    plan.trajectory.waypoints = List([this] {
      return Waypoint{MakePose(), Real(), Real(), Real()};
    });
    plan.trajectory.length_m = Real();
    plan.trajectory.duration_s = Real();
    plan.effort = {Int(), Int(), Int(), Int(), Int()};
    plan.field_flat = Bool();
    plan.goal_kept = Bool();
    plan.start_escaped = Bool();
    plan.explanation = Text();
    plan.cpu_s = Real();
    return plan;
  }

  Rng rng_;
};

}  // namespace plumescout
