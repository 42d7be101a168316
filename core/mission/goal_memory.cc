// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/goal_memory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace plumescout {
namespace {

// A goal that is offered again after this many visits has not changed by being visited.
constexpr int kVisitsBeforeSetAside = 2;
// Nearer than this the map has to change before a goal is worth another try: what a door that
// opens, or a pallet that is taken away, changes.
constexpr double kChangeRadius_m = 1.0;
// Of the variance at the visit before; readings that leave more of it were not worth the way.
constexpr float kVarianceKept = 0.9F;
// Bound the memory of a mission that runs for weeks; the oldest are forgotten.
constexpr std::size_t kMaxVisitedGoals = 1000;
constexpr std::size_t kMaxSetAside = 200;

std::int64_t Nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

// Calls visit(Cell) for the cells within kChangeRadius_m of `place`, always in the same order; some
// may lie outside the map.
template <typename Visit>
void ForCellsNear(const GridGeometry& geometry, Point2 place, Visit&& visit) {
  const Cell middle = geometry.CellAt(place);
  const int reach = static_cast<int>(std::ceil(kChangeRadius_m / geometry.resolution_m));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      if (dx * dx + dy * dy <= reach * reach) visit(Cell{middle.x + dx, middle.y + dy});
    }
  }
}

std::vector<CellState> StatesNear(const Grid<CellState>& map, Point2 place) {
  std::vector<CellState> states;
  ForCellsNear(map.geometry(), place,
               [&](Cell cell) { states.push_back(map.At(cell, CellState::kUnknown)); });
  return states;
}

int ChangedCells(const std::vector<CellState>& then, const Grid<CellState>& map, Point2 place) {
  std::size_t i = 0;
  int changed = 0;
  ForCellsNear(map.geometry(), place, [&](Cell cell) {
    if (map.At(cell, CellState::kUnknown) != then[i++]) ++changed;
  });
  return changed;
}

float VarianceAt_ppm2(Point2 place, const Grid<float>& variance_ppm2) {
  return variance_ppm2.At(variance_ppm2.geometry().CellAt(place),
                          std::numeric_limits<float>::quiet_NaN());
}

}  // namespace

void GoalMemory::Remember(const Goal& goal, ProgressOutcome outcome, const Now& now) {
  std::erase_if(set_aside_, [&](const Entry& entry) { return !Holds(entry, now); });
  if (outcome == ProgressOutcome::kBlocked) {
    Add(goal, "reported blocked", now);
  } else if (outcome == ProgressOutcome::kReached) {
    RememberVisit(goal, now);
  }
}

bool GoalMemory::HasNews(const VisitedGoal& visited, const Now& now) const {
  const Goal& goal = visited.goal;
  if (now.time_ns - visited.last_ns > Nanoseconds(set_aside_s_)) return true;
  if (ChangedCells(visited.states_then, now.map, goal.position) >= min_changed_cells_) return true;
  const bool is_for_readings = goal.kind == GoalKind::kInformation || goal.kind == GoalKind::kSite;
  return is_for_readings && VarianceAt_ppm2(goal.position, now.gas_variance_ppm2) <
                                kVarianceKept * visited.variance_then_ppm2;
}

void GoalMemory::RememberVisit(const Goal& goal, const Now& now) {
  if (goal.kind == GoalKind::kRandomFreeSpace) return;  // nothing was expected to change there
  auto visited = std::find_if(visited_.begin(), visited_.end(),
                              [&](const VisitedGoal& v) { return SamePlace(v.goal, goal); });
  if (visited == visited_.end()) {
    if (visited_.size() >= kMaxVisitedGoals) visited_.erase(visited_.begin());
    visited_.push_back({goal, 0, now.time_ns, StatesNear(now.map, goal.position)});
    visited = visited_.end() - 1;
  }
  visited->visits = HasNews(*visited, now) ? 1 : visited->visits + 1;
  visited->last_ns = now.time_ns;
  visited->states_then = StatesNear(now.map, visited->goal.position);
  visited->variance_then_ppm2 = VarianceAt_ppm2(visited->goal.position, now.gas_variance_ppm2);
  if (visited->visits < kVisitsBeforeSetAside) return;
  visited_.erase(visited);
  Add(goal, "visited without change", now);
}

void GoalMemory::Add(const Goal& goal, const std::string& reason, const Now& now) {
  if (set_aside_.size() >= kMaxSetAside) set_aside_.erase(set_aside_.begin());
  set_aside_.push_back({{goal, reason, now.time_ns + Nanoseconds(set_aside_s_)},
                        StatesNear(now.map, goal.position)});
}

bool GoalMemory::Holds(const Entry& entry, const Now& now) const {
  return entry.aside.expires_ns > now.time_ns &&
         ChangedCells(entry.states_then, now.map, entry.aside.goal.position) < min_changed_cells_;
}

bool GoalMemory::IsOf(double resolution_m) const {
  std::size_t near = 0;
  ForCellsNear({0.0, 0.0, resolution_m, 0, 0}, {}, [&](Cell) { ++near; });
  const auto fits = [near](const auto& remembered) {
    return remembered.states_then.size() == near;
  };
  return std::all_of(visited_.begin(), visited_.end(), fits) &&
         std::all_of(set_aside_.begin(), set_aside_.end(), fits);
}

std::vector<SetAsideGoal> GoalMemory::SetAside(const Now& now) const {
  std::vector<SetAsideGoal> result;
  for (const Entry& entry : set_aside_) {
    if (Holds(entry, now)) result.push_back(entry.aside);
  }
  return result;
}

}  // namespace plumescout
