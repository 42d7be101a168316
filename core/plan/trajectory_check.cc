// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/trajectory_check.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/grid/ray.h"
#include "core/plan/cost/edge_cost.h"
#include "core/plan/cost/information_map.h"
#include "core/plan/departure.h"
#include "core/plan/goals/frontier_goals.h"
#include "core/plan/goals/home_goal.h"
#include "core/plan/paths/shortcut.h"
#include "core/plan/sampling/site_lattice.h"
#include "core/plan/sampling/sites.h"
#include "core/plan/selection/candidate_terms.h"
#include "core/plan/strategy.h"
#include "core/plan/trajectory_timing.h"
#include "core/types/error_reason.h"

namespace plumescout {
namespace {

// Walks a path cell by cell and knows whether the robot can follow.
class Follower {
 public:
  Follower(const Belief& belief, Point2 start)
      : belief_(belief), start_(belief.geometry().CellAt(start)) {}

  bool CanEnter(Cell cell) {
    const bool traversable = belief_.traversable->At(cell, 0) != 0;
    leaving_ = leaving_ && !traversable;
    return traversable || (leaving_ && LeadsOut(cell));
  }

 private:
  // The rule of EscapePath.
  bool LeadsOut(Cell cell) const {
    const Grid<CellState>& states = *belief_.occupancy;
    if (!states.Contains(cell)) return false;
    if (cell == start_ || states[cell] == CellState::kFree) return true;
    return states[cell] == CellState::kUnknown && states[start_] != CellState::kFree;
  }

  const Belief& belief_;
  const Cell start_;
  bool leaving_ = true;  // no traversable cell has been entered yet
};

std::optional<CellState> StateOf(const Belief& belief, Cell cell) {
  if (!belief.occupancy->Contains(cell)) return std::nullopt;
  return (*belief.occupancy)[cell];
}

Point2 Along(Point2 from, Point2 to, double distance_m) {
  const double length_m = Distance_m(from, to);
  const double share = length_m > 0.0 ? std::min(distance_m / length_m, 1.0) : 0.0;
  return {from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m)};
}

RejectedGoal Gone(const Goal& goal) {
  return {goal, RejectionReason::kGone,
          "no frontier of its kind is left there, or none within reach"};
}

// The verdict on the frontier that stands for `goal` now: an offered one if there is any.
std::optional<RejectedGoal> JudgeFrontierGoal(const GoalQuery& query, const Goal& goal) {
  const JudgedFrontier* best = nullptr;
  const auto is_better = [&](const JudgedFrontier& a, const JudgedFrontier& b) {
    if (a.rejection.has_value() != b.rejection.has_value()) return !a.rejection.has_value();
    return Distance_m(a.goal.position, goal.position) < Distance_m(b.goal.position, goal.position);
  };
  const std::vector<JudgedFrontier> frontiers = JudgeFrontiers(query);
  for (const JudgedFrontier& frontier : frontiers) {
    if (!ClaimCovers(goal, frontier.goal)) continue;
    if (best == nullptr || is_better(frontier, *best)) best = &frontier;
  }
  return best == nullptr ? Gone(goal) : best->rejection;
}

std::optional<RejectedGoal> JudgePlace(const GoalQuery& query, const Goal& goal) {
  const bool is_home = goal.kind == GoalKind::kHome;
  const Cell cell = query.belief.geometry().CellAt(goal.position);
  const bool reachable = is_home ? FindHome(query).reachable : query.reachable.At(cell, 0) != 0;
  if (!reachable) return RejectedGoal{goal, RejectionReason::kUnreachable, "no traversable way"};
  return is_home ? std::nullopt : RejectedByMemory(query, goal);
}

std::optional<RejectedGoal> JudgeSite(const GoalQuery& query, const IntendedPath& path) {
  if (std::optional<RejectedGoal> rejected = JudgePlace(query, path.goal)) return rejected;
  if (path.stops.empty() || !SamplesOnce(query.options)) return std::nullopt;
  const SiteLattice lattice = LatticeOver(query.belief.geometry(), query.options.sites);
  if (!AreSampled(query.belief, lattice, path.stops)) return std::nullopt;
  return RejectedGoal{path.goal, RejectionReason::kGone, "all its sites have been sampled"};
}

std::optional<RejectedGoal> JudgeGoal(const Belief& belief, const RobotRecord& robot,
                                      const IntendedPath& path, PlanningOptions options) {
  if (!belief.occupancy->Contains(belief.geometry().CellAt(path.vertices.front()))) {
    return RejectedGoal{path.goal, RejectionReason::kUnreachable, "the path begins off the map"};
  }
  options.min_goal_distance_m = 0.0;
  const Reach reach = ReachFrom(belief, path.vertices.front());
  const GoalQuery query = {belief, robot, reach.start, reach.reachable, options};
  if (path.goal.kind == GoalKind::kSite) return JudgeSite(query, path);
  const bool is_frontier =
      path.goal.kind == GoalKind::kGasFrontier || path.goal.kind == GoalKind::kOccupancyFrontier;
  return is_frontier ? JudgeFrontierGoal(query, path.goal) : JudgePlace(query, path.goal);
}

// Prices a path without blockage. As in a plan, a way out of the inflated zone counts as length.
Candidate Price(const Belief& belief, const RobotRecord& robot, const IntendedPath& path,
                const PlanningOptions& options) {
  const MissionOptions& mission = *belief.options;
  const InformationMap information =
      MakeInformationMap({*belief.traversable, *belief.gas_mean_ppm, *belief.gas_variance_ppm2,
                          mission.gas, mission.frontier},
                         options);
  const EdgeCost cost(information, options.selection_cost, options.alpha_per_m);
  const std::vector<Point2>& vertices = path.vertices;
  const auto out = std::find_if(vertices.begin(), vertices.end(), [&](Point2 vertex) {
    return belief.traversable->At(belief.geometry().CellAt(vertex), 0) != 0;
  });
  Candidate rest = MakeCandidate(path.goal, {out, vertices.end()}, PathSource::kGridSearch,
                                 {cost, *belief.gas_mean_ppm, mission.gas.background_mean_ppm});
  rest.path = vertices;
  for (auto vertex = vertices.begin(); vertex != out; ++vertex) {
    rest.length_m += Distance_m(*vertex, *std::next(vertex));
  }
  rest.stops = path.stops;
  const double yaw_rad = robot.state.pose.yaw_rad;
  rest.duration_s = path.goal.kind == GoalKind::kSite
                        ? TimeTrajectory(vertices, path.stops, yaw_rad, options).duration_s
                        : TimeTrajectory(vertices, yaw_rad, options).duration_s;
  return rest;
}

// Without the vertices in the middle of straight runs that are no stops.
std::vector<Point2> WithoutNeedless(const std::vector<Point2>& vertices,
                                    const std::vector<Point2>& stops) {
  std::vector<Point2> kept;
  std::vector<Point2> run;  // from stop to stop
  auto stop = stops.begin();
  for (const Point2 vertex : vertices) {
    run.push_back(vertex);
    if (stop == stops.end() || *stop != vertex) continue;
    ++stop;
    const std::vector<Point2> straight = WithoutCollinear(run);
    kept.insert(kept.end(), straight.begin(), straight.end() - 1);
    run = {vertex};
  }
  const std::vector<Point2> straight = WithoutCollinear(run);
  kept.insert(kept.end(), straight.begin(), straight.end());
  return kept;
}

absl::Status CheckIsLatest(const Belief& belief, const RobotRecord& robot, PlanId plan) {
  PlanId newest = 0;
  for (const auto& [id, record] : belief.robots) newest = std::max(newest, record.last_plan);
  if (plan > newest) return absl::NotFoundError(absl::StrCat("plan ", plan, " was never issued"));
  if (plan == robot.last_plan) return absl::OkStatus();
  return TypedError(absl::StatusCode::kFailedPrecondition, reason::kPlanSuperseded,
                    absl::StrCat("plan ", plan, " is not robot \"", robot.state.id, "\"'s latest, ",
                                 robot.last_plan));
}

}  // namespace

std::optional<Blockage> FindBlockage(const Belief& belief, const std::vector<Point2>& path) {
  const GridGeometry& geometry = belief.geometry();
  Follower follower(belief, path.front());
  std::optional<Blockage> found;
  double before_m = 0.0;  // the current segment
  for (std::size_t i = std::min<std::size_t>(1, path.size() - 1); i < path.size(); ++i) {
    const Point2 from = path[i > 0 ? i - 1 : 0];
    double inside_m = 0.0;
    WalkSegment(geometry, from, path[i], [&](Cell cell, double length_cells) {
      if (!follower.CanEnter(cell)) {
        found = {cell, Along(from, path[i], inside_m), before_m + inside_m, StateOf(belief, cell)};
        return false;
      }
      inside_m += length_cells * geometry.resolution_m;
      return true;
    });
    if (found) return found;
    before_m += Distance_m(from, path[i]);
  }
  // It may never have left the inflated zone.
  const Cell last = geometry.CellAt(path.back());
  if (belief.traversable->At(last, 0) != 0) return std::nullopt;
  return Blockage{last, path.back(), before_m, StateOf(belief, last)};
}

absl::StatusOr<IntendedPath> RestOfPlan(const Belief& belief, const RobotId& robot, PlanId plan) {
  const auto found = belief.robots.find(robot);
  if (found == belief.robots.end()) {
    return absl::NotFoundError(absl::StrCat("robot \"", robot, "\" is not registered"));
  }
  const RobotRecord& record = found->second;
  if (absl::Status status = CheckIsLatest(belief, record, plan); !status.ok()) return status;
  if (!record.live_goal || record.live_trajectory == nullptr ||
      record.live_trajectory->waypoints.empty()) {
    return TypedError(absl::StatusCode::kFailedPrecondition, reason::kPlanEnded,
                      absl::StrCat("plan ", plan, " has nothing left to drive"));
  }
  const Trajectory& live = *record.live_trajectory;
  const double now_s = FindOnWay(live, record.state.pose.position(), record.live_gone_s)->time_s;
  IntendedPath rest{{PoseAt(live, now_s).position()}, *record.live_goal};
  for (const Waypoint& waypoint : live.waypoints) {
    if (waypoint.arrival_time_s <= now_s) continue;
    rest.vertices.push_back(waypoint.pose.position());
    const bool samples = rest.goal.kind == GoalKind::kSite && waypoint.dwell_s > 0.0;
    if (samples) rest.stops.push_back(waypoint.pose.position());
  }
  // A robot that turns or changes its speed has waypoints that are no vertices.
  rest.vertices.erase(std::unique(rest.vertices.begin(), rest.vertices.end()), rest.vertices.end());
  rest.vertices = WithoutNeedless(rest.vertices, rest.stops);
  return rest;
}

IntendedPath PathTo(GoalKind kind, std::vector<Point2> vertices, const GridGeometry& geometry) {
  const Point2 end = vertices.back();
  IntendedPath path = {std::move(vertices), {kind, geometry.CellAt(end), end, end, 0}};
  if (kind == GoalKind::kSite) path.stops = {end};
  return path;
}

TrajectoryVerdict CheckTrajectory(const Belief& belief, const RobotId& robot,
                                  const IntendedPath& path, const PlanningOptions& options) {
  const RobotRecord& record = belief.robots.at(robot);
  TrajectoryVerdict check;
  check.blockage = FindBlockage(belief, path.vertices);
  check.rejection = JudgeGoal(belief, record, path, options);
  if (!check.blockage) check.rest = Price(belief, record, path, options);
  return check;
}

}  // namespace plumescout
