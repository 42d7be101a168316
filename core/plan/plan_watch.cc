// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/plan_watch.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/grid/ray.h"
#include "core/occupancy/keep_out.h"
#include "core/plan/trajectory_check.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

double Seconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) * 1e-9; }

bool HasWay(const RobotRecord& record) {
  return record.live_trajectory != nullptr && !record.live_trajectory->waypoints.empty();
}

bool Drives(const RobotRecord& record, std::int64_t now_ns) {
  return HasWay(record) && record.state.has_pose && !record.state.silent &&
         IsOnItsWay(record, now_ns);
}

PlanInvalidated Barrier(const RobotRecord& record, InvalidationReason reason, Point2 place,
                        const char* what) {
  return {.plan = record.last_plan,
          .reason = reason,
          .place = place,
          .detail = absl::StrFormat("%s at (%.1f, %.1f)", what, place.x_m, place.y_m)};
}

// The first place of the way where something stands; it may begin in such a place.
std::optional<Point2> FindObstacle(const Belief& belief, const std::vector<Point2>& way) {
  const GridGeometry& geometry = belief.geometry();
  std::optional<Point2> found;
  bool has_left = false;  // the cells in which it began
  const auto enter = [&](Cell cell, double) {
    if (belief.traversable->At(cell, 0) != 0) {
      has_left = true;
    } else if (has_left &&
               belief.occupancy->At(cell, CellState::kUnknown) == CellState::kOccupied) {
      found = geometry.Center(cell);
    }
    return !found.has_value();
  };
  for (std::size_t i = 1; i < way.size() && !found; ++i) {
    WalkSegment(geometry, way[i - 1], way[i], enter);
  }
  return found;
}

// Where the rest of the way cannot be driven.
std::vector<PlanInvalidated> FindBarriers(const Belief& belief, const RobotRecord& record) {
  std::vector<PlanInvalidated> found;
  const auto path = RestOfPlan(belief, record.state.id, record.last_plan);
  if (!path.ok()) return found;
  const std::vector<Polygon>& areas = belief.options->keep_out;
  if (!areas.empty()) {
    const auto cell = FirstKeptOut(KeptOutCells(areas, belief.geometry()), path->vertices);
    if (cell) {
      found.push_back(Barrier(record, InvalidationReason::kKeptOut, belief.geometry().Center(*cell),
                              "nobody may drive"));
    }
  }
  if (const auto place = FindObstacle(belief, path->vertices)) {
    found.push_back(Barrier(record, InvalidationReason::kWayBlocked, *place, "something stands"));
  }
  return found;
}

}  // namespace

std::vector<PlanWatch::News> PlanWatch::Look(const Belief& belief) {
  std::vector<News> news;
  const auto has_left = [&](const auto& entry) { return belief.robots.count(entry.first) == 0; };
  std::erase_if(known_, has_left);
  std::erase_if(spots_, has_left);
  NoteStanding(belief);
  areas_are_new_ = options_seen_ != belief.options;
  options_seen_ = belief.options;
  for (const auto& [id, record] : belief.robots) {
    Known& known = known_[id];
    if (const auto ended = NoteEnd(record, known)) news.push_back({id, *ended});
    const bool assigned = known.live && record.assigned_plan == known.plan;
    if (assigned && !known.assigned) news.push_back({id, PlanAssigned{known.plan}});
    known.assigned = assigned;
    std::vector<PlanInvalidated> found;
    if (known.live && Drives(record, belief.sample_time_ns)) {
      found = FindBarriers(belief, record);
      if (const auto meeting = FindMeeting(belief, record)) found.push_back(*meeting);
    }
    for (PlanInvalidated& ripe : Ripe(std::move(found), belief.sample_time_ns, known)) {
      news.push_back({id, std::move(ripe)});
    }
  }
  return news;
}

void PlanWatch::NoteStanding(const Belief& belief) {
  const std::int64_t now_ns = belief.sample_time_ns;
  standing_.clear();
  for (const auto& [id, record] : belief.robots) {
    if (!record.state.has_pose) continue;
    const Point2 place = record.state.pose.position();
    const auto [spot, is_new] = spots_.try_emplace(id, Spot{place, now_ns});
    if (!is_new && Distance_m(spot->second.place, place) > options_.least_move_m) {
      spot->second = {place, now_ns};
    }
    const bool stays = Seconds(now_ns - spot->second.since_ns) >= options_.patience_s;
    const bool stands_by_plan =
        Drives(record, now_ns) && Lateness_s(record, now_ns) < options_.patience_s;
    if (stays && !stands_by_plan) standing_.insert(id);
  }
}

std::map<RobotId, RobotRecord> PlanWatch::BeforeIt(const Belief& belief,
                                                   const RobotRecord& robot) const {
  std::map<RobotId, RobotRecord> before;
  for (const auto& [id, other] : belief.robots) {
    const double apart_m = Distance_m(other.state.pose.position(), robot.state.pose.position());
    const bool touches = apart_m < other.state.radius_m + robot.state.radius_m;
    const bool stands = standing_.count(id) > 0;
    const bool gives_way = other.last_plan > robot.last_plan && !stands && !touches &&
                           Drives(other, belief.sample_time_ns);
    if (gives_way) continue;
    RobotRecord& record = before.emplace(id, other).first->second;
    if (stands) record.live_trajectory = nullptr;
  }
  return before;
}

std::optional<PlanInvalidated> PlanWatch::NoteEnd(const RobotRecord& record, Known& known) const {
  const Known before = known;
  if (record.last_plan != before.plan) known = Known{.plan = record.last_plan};
  known.live = HasWay(record);
  if (!before.live) return std::nullopt;
  PlanInvalidated ended{.plan = before.plan};
  if (known.plan != before.plan && record.assigned_plan == known.plan) {
    ended.reason = InvalidationReason::kSuperseded;
    ended.detail = absl::StrCat("it was given plan ", known.plan);
    return ended;
  }
  if (known.plan == before.plan && !known.live && record.state.silent) {
    ended.reason = InvalidationReason::kLapsed;
    ended.detail = "it was not heard of for too long";
    return ended;
  }
  return std::nullopt;
}

std::vector<PlanInvalidated> PlanWatch::Ripe(std::vector<PlanInvalidated> found,
                                             std::int64_t now_ns, Known& known) const {
  std::map<Cause, std::int64_t> since_ns;
  std::vector<PlanInvalidated> ripe;
  for (PlanInvalidated& one : found) {
    const Cause cause = {one.reason, one.robot};
    const auto before = known.since_ns.find(cause);
    const std::int64_t first_ns = before == known.since_ns.end() ? now_ns : before->second;
    since_ns[cause] = first_ns;
    const bool lasts =
        Seconds(now_ns - first_ns) >= options_.patience_s ||
        (one.reason == InvalidationReason::kKeptOut && areas_are_new_) ||
        (one.reason == InvalidationReason::kMeetsRobot && standing_.count(one.robot) > 0);
    if (lasts && known.told.insert(cause).second) ripe.push_back(std::move(one));
  }
  known.since_ns = std::move(since_ns);
  return ripe;
}

std::optional<PlanInvalidated> PlanWatch::FindMeeting(const Belief& belief,
                                                      const RobotRecord& record) const {
  const PlanningOptions& planning = belief.options->planning;
  const std::map<RobotId, RobotRecord> before = BeforeIt(belief, record);
  if (!planning.yield_to_robots || before.size() < 2) return std::nullopt;
  const double clearance_m = std::min(options_.clearance_m, planning.robot_clearance_m);
  const Traffic traffic(before, record.state.id, clearance_m, belief.sample_time_ns,
                        Traffic::Others::kOnTime);
  const std::optional<Meeting> meeting =
      traffic.FirstMeeting(*record.live_trajectory, Progress_s(record, belief.sample_time_ns));
  if (!meeting || meeting->time_s > options_.horizon_s) return std::nullopt;
  return PlanInvalidated{.plan = record.last_plan,
                         .reason = InvalidationReason::kMeetsRobot,
                         .robot = meeting->robot,
                         .meets_in_s = meeting->time_s,
                         .place = meeting->place,
                         .detail = absl::StrFormat(
                             "it would meet robot \"%s\" at (%.1f, %.1f) in %.1f s", meeting->robot,
                             meeting->place.x_m, meeting->place.y_m, meeting->time_s)};
}

}  // namespace plumescout
