// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/match.h"
#include "core/grid/distance_field.h"
#include "core/mission/fleet.h"
#include "core/plan/strategy.h"
#include "core/traffic/traffic.h"

namespace plumescout::support {

struct Room {
  Point2 min;
  Point2 max;
};

struct Contestant {
  RobotId robot;
  Point2 start;
  std::optional<Point2> target;  // none: it has nothing to do
};

// What became of them.
struct GauntletResult {
  int contacts = 0;
  int arrivals = 0;
  int make_ways = 0;
  int deadlocks_broken = 0;
  int unresolved = 0;            // robots that stood for their last 10 s, short of their target
  double longest_stand_s = 0.0;  // of those that had not arrived
  double last_arrival_s = 0.0;
};

// Robots on a known map, each with a place to drive to, in lockstep: they follow their plans
// exactly, ask for the next at the end of each, and every second while they are to stay.
class TeamGauntlet {
 public:
  static constexpr double kInflation_m = 0.2;

  TeamGauntlet(double width_m, double height_m, const std::vector<Room>& rooms,
               const std::vector<Contestant>& contestants) {
    planning_.strategy = "plumescout";
    ok_ = ApplyStrategyRow(planning_).ok();
    planning_.paths = PathKind::kGridExact;
    auto strategy = MakeStrategy(planning_);
    ok_ = ok_ && strategy.ok();
    if (strategy.ok()) strategy_ = *std::move(strategy);
    MakeMap(width_m, height_m, rooms);
    for (const Contestant& one : contestants) {
      ok_ = ok_ && fleet_.Register({one.robot, 0.2, 1}, 64).ok();
      drivers_.push_back({one, {one.start.x_m, one.start.y_m, 0.0}});
    }
  }

  GauntletResult Run(double duration_s) {
    for (int step = 1; ok_ && step <= static_cast<int>(duration_s / kStep_s); ++step) {
      now_s_ = kStep_s * step;
      for (Driver& driver : drivers_) Move(driver);
      for (Driver& driver : drivers_) Observe(driver);
      for (Driver& driver : drivers_) {
        if (!driver.plan && now_s_ >= driver.asks_s) Ask(driver);
      }
    }
    for (const Driver& driver : drivers_) {
      if (driver.one.target && !driver.arrived && now_s_ - driver.moved_s > 10.0) {
        ++result_.unresolved;
      }
    }
    return result_;
  }
  bool ok() const { return ok_; }

 private:
  static constexpr double kStep_s = 0.25;
  static constexpr double kRadius_m = 0.2;

  struct Driver {
    Contestant one;
    Pose2 pose;
    std::optional<Plan> plan = std::nullopt;
    PlanId plan_id = 0;
    double began_s = 0.0;
    double asks_s = 0.0;
    std::int64_t sequence = 0;
    bool arrived = false;
    Point2 stood = {};
    double moved_s = 0.0;
  };

  void MakeMap(double width_m, double height_m, const std::vector<Room>& rooms) {
    const GridGeometry geometry{0.0, 0.0, 0.1, static_cast<int>(std::lround(width_m / 0.1)),
                                static_cast<int>(std::lround(height_m / 0.1))};
    Grid<CellState> states(geometry, CellState::kOccupied);
    Grid<std::uint8_t> walls(geometry, 1);
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Point2 place = geometry.Center(geometry.CellAtIndex(i));
      for (const Room& room : rooms) {
        if (place.x_m > room.min.x_m && place.x_m < room.max.x_m && place.y_m > room.min.y_m &&
            place.y_m < room.max.y_m) {
          states[i] = CellState::kFree;
          walls[i] = 0;
        }
      }
    }
    const Grid<std::int32_t> distance_cells2 = SquaredDistances_cells2(walls);
    Grid<std::uint8_t> traversable(geometry, 0);
    Grid<float> mean(geometry, 0.0F);
    Grid<float> variance(geometry, 1.0F);
    for (std::size_t i = 0; i < traversable.size(); ++i) {
      traversable[i] = distance_cells2[i] > 4 ? 1 : 0;  // of kInflation_m
    }
    belief_.revision = 1;
    belief_.options = std::make_shared<const MissionOptions>();
    belief_.occupancy = std::make_shared<const Grid<CellState>>(std::move(states));
    belief_.traversable = std::make_shared<const Grid<std::uint8_t>>(std::move(traversable));
    belief_.gas_mean_ppm = std::make_shared<const Grid<float>>(std::move(mean));
    belief_.gas_variance_ppm2 = std::make_shared<const Grid<float>>(std::move(variance));
    belief_.sampled = std::make_shared<const Grid<std::uint8_t>>(geometry, 0);
  }

  std::int64_t Now_ns() const { return std::llround(now_s_ * 1e9) + 1'000'000'000; }

  void Move(Driver& driver) {
    if (!driver.plan) return;
    const Pose2 next = PoseAt(driver.plan->trajectory, now_s_ - driver.began_s);
    for (const Driver& other : drivers_) {
      if (&other == &driver) continue;
      const double apart_m = Distance_m(next.position(), other.pose.position());
      if (apart_m < 2.0 * kRadius_m - 0.02 &&
          apart_m < Distance_m(driver.pose.position(), other.pose.position())) {
        ++result_.contacts;
        End(driver, ProgressOutcome::kBlocked);
        return;
      }
    }
    driver.pose = next;
    if (now_s_ - driver.began_s >= driver.plan->trajectory.duration_s) {
      End(driver, ProgressOutcome::kReached);
    }
  }

  void End(Driver& driver, ProgressOutcome outcome) {
    ok_ = ok_ && fleet_.Report({driver.one.robot, driver.plan_id, outcome}).ok();
    driver.plan.reset();
    driver.asks_s = now_s_;
  }

  void Observe(Driver& driver) {
    const Observation observation{++driver.sequence, Now_ns(), driver.pose, GasReading{}};
    fleet_.Advance(driver.one.robot, observation, false);
    fleet_.Hear(driver.one.robot, Now_ns());
    const Point2 place = driver.pose.position();
    if (Distance_m(place, driver.stood) > 0.2) {
      driver.stood = place;
      driver.moved_s = now_s_;
    }
    if (!driver.one.target || driver.arrived) return;
    result_.longest_stand_s = std::max(result_.longest_stand_s, now_s_ - driver.moved_s);
    if (Distance_m(place, *driver.one.target) > 0.7) return;
    driver.arrived = true;
    ++result_.arrivals;
    result_.last_arrival_s = now_s_;
  }

  void Ask(Driver& driver) {
    belief_.sample_time_ns = Now_ns();
    belief_.robots = fleet_.Records();
    belief_.claims = fleet_.Claims(Now_ns());
    for (const Driver& other : drivers_) {
      belief_.robots.at(other.one.robot).first_place =
          other.one.target.value_or(other.pose.position());
    }
    PlanRequest request;
    request.robot = driver.one.robot;
    request.go_home = true;
    const auto plan = strategy_->Plan(belief_, request, NeverStop());
    ok_ = ok_ && plan.ok();
    if (!plan.ok()) return;
    const auto id = fleet_.Issue(*plan, Now_ns());
    ok_ = ok_ && id.ok();
    if (!id.ok()) return;
    driver.asks_s = now_s_ + 1.0;
    if (plan->chosen < 0) return;
    driver.plan = *plan;
    driver.plan_id = *id;
    driver.began_s = now_s_;
    if (plan->candidates[0].goal.kind != GoalKind::kMakeWay) return;
    ++result_.make_ways;
    if (absl::StrContains(plan->explanation, "deadlock")) ++result_.deadlocks_broken;
  }

  bool ok_ = true;
  PlanningOptions planning_;
  std::unique_ptr<const Strategy> strategy_;
  Belief belief_;
  Fleet fleet_;
  std::vector<Driver> drivers_;
  GauntletResult result_;
  double now_s_ = 0.0;
};

}  // namespace plumescout::support
