// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/make_way.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/grid/grid_search.h"
#include "core/plan/blockade.h"
#include "core/plan/right_of_way.h"
#include "core/plan/sampling/ways.h"
#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

using Records = std::map<RobotId, RobotRecord>;
using Blocked = std::vector<BlockedRobot>;

// A place to stand out of others' ways.
struct Retreat {
  Cell cell;
  double travel_m = 0.0;
};

// The robots as they are when this one starts, with what its plan says that it wants.
Records RecordsNow(const Belief& belief, const Departure& departure, const Plan& plan) {
  Records robots = belief.robots;
  RobotRecord& own = robots.at(plan.robot);
  const Point2 place = departure.way_out.empty() ? departure.start : departure.way_out.front();
  own.state.has_pose = true;
  own.state.silent = false;
  own.state.pose = {place.x_m, place.y_m, departure.yaw_rad};
  own.live_trajectory = nullptr;
  const auto wanted = std::find_if(
      plan.rejected.begin(), plan.rejected.end(),
      [](const RejectedGoal& goal) { return goal.reason == RejectionReason::kTraffic; });
  if (wanted == plan.rejected.end()) {
    own.wanted_goal.reset();
    return robots;
  }
  if (!own.wanted_goal && own.wanted_since_ns == 0) own.wanted_since_ns = belief.sample_time_ns;
  own.wanted_goal = wanted->goal;
  return robots;
}

bool IsBlockedBy(const BlockedRobot& blocked, const RobotId& robot) {
  return std::count(blocked.by.begin(), blocked.by.end(), robot) > 0;
}

// The others, or those of them whom the robot blocks.
Blocked OthersOf(const Blocked& blocked, const RobotId& robot, bool by_robot_only) {
  Blocked others;
  for (const BlockedRobot& one : blocked) {
    if (one.robot != robot && (!by_robot_only || IsBlockedBy(one, robot))) others.push_back(one);
  }
  return others;
}

// Looks for places where a robot is out of the way.
class Retreats {
 public:
  Retreats(const Belief& belief, const Records& robots, const PlanningOptions& options)
      : belief_(belief), robots_(robots), options_(options) {}

  Point2 PlaceOf(const RobotId& robot) const { return robots_.at(robot).state.pose.position(); }
  Grid<std::uint8_t> OpenFor(const RobotId& robot) const {
    return OpenTo(belief_, robots_, robot, PlaceOf(robot), options_);
  }

  // The nearest first, each so far from those before it that it is another place; at most `count`.
  std::vector<Retreat> Find(const RobotId& robot, const Blocked& keep_off,
                            std::size_t count) const {
    const std::optional<Departure> departure = Depart(belief_, PlaceOf(robot));
    if (!departure) return {};
    const GridGeometry& geometry = belief_.geometry();
    const Grid<double> travel_m =
        TravelDistances_m(OpenFor(robot), std::vector<Cell>{geometry.CellAt(departure->start)});
    Grid<std::uint8_t> off(geometry, 1);
    for (const BlockedRobot& other : keep_off) CloseWay(other, robot, off);
    std::vector<Retreat> all;
    for (std::size_t i = 0; i < off.size(); ++i) {
      const Cell cell = geometry.CellAtIndex(i);
      if (off[i] != 0 && travel_m[i] < kUnreached_m && IsFree(robot, geometry.Center(cell))) {
        all.push_back({cell, travel_m[i]});
      }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Retreat& a, const Retreat& b) { return a.travel_m < b.travel_m; });
    return Spread(all, count);
  }

 private:
  // By the doubt of its heading where it is, as traffic has it, and by that on the way.
  void CloseWay(const BlockedRobot& other, const RobotId& robot, Grid<std::uint8_t>& off) const {
    const RobotState& self = robots_.at(robot).state;
    RobotState passing = robots_.at(other.robot).state;
    const double here_m = Apart_m(self, passing, options_.robot_clearance_m);
    for (const Point2 point : other.way) {
      passing.pose = {point.x_m, point.y_m, 0.0};
      constexpr double kFar_m = std::numeric_limits<double>::infinity();
      const double there_m = Apart_m(self, passing, options_.robot_clearance_m);
      CloseDisc(point, std::max(here_m, there_m), {kFar_m, kFar_m}, off);
    }
  }
  // Nobody else is about to do something there, and a robot that samples a region stays in it.
  bool IsFree(const RobotId& robot, Point2 place) const {
    if (const auto& region = options_.sites.region) {
      const bool inside = place.x_m >= region->min.x_m && place.x_m <= region->max.x_m &&
                          place.y_m >= region->min.y_m && place.y_m <= region->max.y_m;
      if (!inside) return false;
    }
    return std::none_of(belief_.claims.begin(), belief_.claims.end(), [&](const GoalClaim& claim) {
      return claim.robot != robot && Distance_m(claim.goal.position, place) < kClaimRadius_m;
    });
  }
  std::vector<Retreat> Spread(const std::vector<Retreat>& all, std::size_t count) const {
    constexpr double kAnotherPlace_m = 0.4;
    const GridGeometry& geometry = belief_.geometry();
    std::vector<Retreat> spread;
    for (const Retreat& one : all) {
      if (spread.size() >= count) break;
      const bool is_new = std::none_of(spread.begin(), spread.end(), [&](const Retreat& before) {
        return Distance_m(geometry.Center(before.cell), geometry.Center(one.cell)) <
               kAnotherPlace_m;
      });
      if (is_new) spread.push_back(one);
    }
    return spread;
  }

  const Belief& belief_;
  const Records& robots_;
  const PlanningOptions& options_;
};

double Shortest_m(const Retreats& retreats, const Blocked& blocked, const RobotId& robot) {
  for (const bool by_robot_only : {false, true}) {
    const auto found = retreats.Find(robot, OthersOf(blocked, robot, by_robot_only), 1);
    if (!found.empty()) return found.front().travel_m;
  }
  return std::numeric_limits<double>::infinity();
}

// Whether it is this robot's turn to break the ring.
bool IsItsTurn(const Retreats& retreats, const Blocked& blocked, const Blocked& ring,
               const RobotId& robot) {
  double lasts_s = std::numeric_limits<double>::infinity();
  for (const BlockedRobot& one : ring) lasts_s = std::min(lasts_s, one.waits_s);
  if (lasts_s < kRingPatience_s) return false;
  const double own_m = Shortest_m(retreats, blocked, robot);
  if (std::isinf(own_m)) return false;
  int before = 0;
  for (const BlockedRobot& one : ring) {
    if (one.robot == robot) continue;
    const double other_m = Shortest_m(retreats, blocked, one.robot);
    if (other_m < own_m || (other_m == own_m && one.robot < robot)) ++before;
  }
  return lasts_s >= kRingPatience_s * (1.0 + before);
}

// Why the robot makes way; none: it does not.
std::optional<std::string> Reason(const Retreats& retreats, const Blocked& blocked,
                                  const Records& robots, const RobotId& robot) {
  const Blocked ring = FindRing(blocked, robot);
  if (ring.size() > 1) {
    if (!IsItsTurn(retreats, blocked, ring, robot)) return std::nullopt;
    std::string names;
    for (const BlockedRobot& one : ring) {
      if (one.robot == robot) continue;
      absl::StrAppend(&names, names.empty() ? "\"" : ", \"", one.robot, "\"");
    }
    return absl::StrCat("to break the deadlock with ", names);
  }
  const bool wants = robots.at(robot).wanted_goal.has_value();
  for (const BlockedRobot& one : blocked) {
    if (!IsBlockedBy(one, robot)) continue;
    if (wants && (one.by.size() > 1 || one.waits_s < kRingPatience_s)) continue;
    return absl::StrCat("to make way for \"", one.robot, "\"");
  }
  return std::nullopt;
}

Candidate WayTo(const Belief& belief, const Departure& departure, const Grid<std::uint8_t>& open,
                Cell cell, const PlanningOptions& options) {
  Candidate candidate;
  candidate.goal.kind = GoalKind::kMakeWay;
  candidate.goal.cell = cell;
  candidate.goal.position = belief.geometry().Center(cell);
  candidate.goal.centroid = candidate.goal.position;
  candidate.path_source = PathSource::kGridSearch;
  candidate.path = departure.way_out;
  const Way way = WaysFrom(open, departure.start, {candidate.goal.position}).front();
  candidate.path.insert(candidate.path.end(), way.vertices.begin(), way.vertices.end());
  for (std::size_t i = 1; i < candidate.path.size(); ++i) {
    candidate.length_m += Distance_m(candidate.path[i - 1], candidate.path[i]);
  }
  candidate.cost = candidate.length_m;
  candidate.duration_s = TimeTrajectory(candidate.path, departure.yaw_rad, options).duration_s;
  return candidate;
}

// A way to one of the places that meets nobody, the wait before it included.
std::optional<Candidate> FindClearWay(const Belief& belief, const Departure& departure,
                                      const Grid<std::uint8_t>& open,
                                      const std::vector<Retreat>& retreats,
                                      const PlanningOptions& options, const Traffic& traffic) {
  for (const Retreat& retreat : retreats) {
    Candidate candidate = WayTo(belief, departure, open, retreat.cell, options);
    if (candidate.path.size() < 2) continue;
    const std::optional<double> wait_s =
        traffic.LeastWait_s(TimeTrajectory(candidate.path, departure.yaw_rad, options));
    if (!wait_s) continue;
    candidate.duration_s += *wait_s;
    return candidate;
  }
  return std::nullopt;
}

void Take(Candidate candidate, const std::string& reason, double start_yaw_rad,
          const PlanningOptions& options, Plan& plan) {
  plan.candidates = {std::move(candidate)};
  plan.chosen = 0;
  plan.waits_for.clear();
  plan.end = plan.rejected.empty() ? PlanEnd::kAllGoalsReached : PlanEnd::kQueueExhausted;
  if (plan.phase == MissionPhase::kComplete) plan.phase = MissionPhase::kFallback;
  Candidate& chosen = plan.candidates.front();
  plan.trajectory = TrajectoryOf(chosen, start_yaw_rad, options);
  plan.trajectory.waypoints.back().dwell_s += kStandAside_s;
  plan.trajectory.duration_s += kStandAside_s;
  chosen.duration_s += kStandAside_s;
  plan.explanation = absl::StrFormat("Drive %.1f m to (%.1f, %.1f) %s.", chosen.length_m,
                                     chosen.goal.position.x_m, chosen.goal.position.y_m, reason);
}

}  // namespace

void MakeWay(const Belief& belief, const Departure& departure, const PlanningOptions& options,
             const StopFn& stop, Plan& plan) {
  const bool would_stay = plan.chosen < 0 && plan.end != PlanEnd::kStartOccupied;
  if (!options.yield_to_robots || belief.robots.size() < 2 || !would_stay || stop()) return;
  const Records robots = RecordsNow(belief, departure, plan);
  const Blocked blocked = FindBlockedRobots(belief, robots, options);
  if (OthersOf(blocked, plan.robot, /*by_robot_only=*/true).empty() || stop()) return;
  const Retreats retreats(belief, robots, options);
  const std::optional<std::string> reason = Reason(retreats, blocked, robots, plan.robot);
  if (!reason) return;
  constexpr std::size_t kMostPlaces = 10;
  const Grid<std::uint8_t> open = retreats.OpenFor(plan.robot);
  // If there is no place off the ways that are kept for others, better one on them than none.
  std::vector<Traffic> traffics = {TrafficAround(belief, plan.robot, options)};
  if (traffics.front().keeps_ways()) {
    traffics.emplace_back(belief.robots, plan.robot, options.robot_clearance_m,
                          belief.sample_time_ns);
  }
  for (const Traffic& traffic : traffics) {
    for (const bool by_robot_only : {false, true}) {
      const std::vector<Retreat> places =
          retreats.Find(plan.robot, OthersOf(blocked, plan.robot, by_robot_only), kMostPlaces);
      std::optional<Candidate> way =
          FindClearWay(belief, departure, open, places, options, traffic);
      if (way) return Take(*std::move(way), *reason, departure.yaw_rad, options, plan);
    }
  }
}

}  // namespace plumescout
