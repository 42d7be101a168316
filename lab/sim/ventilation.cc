// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/ventilation.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace plumescout::lab {
namespace {

constexpr int kTries = 40;  // to find a place for a window
constexpr int kApart = 4;   // between the zones of two windows

// Whether the room's wall on this side is an outer wall.
bool IsOuter(const FloorPlan& plan, const CellRect& floor, Side side) {
  switch (side) {
    case Side::kWest:
      return floor.min.x == 1;
    case Side::kEast:
      return floor.end.x == plan.width - 1;
    case Side::kSouth:
      return floor.min.y == 1;
    case Side::kNorth:
      return floor.end.y == plan.height - 1;
  }
  return false;
}

CellRect ZoneOf(const CellRect& floor, Side side, int from, int width) {
  constexpr int kDepth = 6;  // 1.2 m
  switch (side) {
    case Side::kWest:
      return CellRect::Sized({floor.min.x, from}, kDepth, width);
    case Side::kEast:
      return CellRect::Sized({floor.end.x - kDepth, from}, kDepth, width);
    case Side::kSouth:
      return CellRect::Sized({from, floor.min.y}, width, kDepth);
    case Side::kNorth:
      return CellRect::Sized({from, floor.end.y - kDepth}, width, kDepth);
  }
  return {};
}

// From middle to middle, along the axes.
int Distance(const CellRect& a, const CellRect& b) {
  return (std::abs(a.min.x + a.end.x - b.min.x - b.end.x) +
          std::abs(a.min.y + a.end.y - b.min.y - b.end.y)) /
         2;
}

int DoorsOf(const FloorPlan& plan, std::size_t room) {
  int doors = 0;
  for (const Partition& wall : plan.partitions) {
    for (const PlanDoor& door : wall.doors) {
      const bool here = static_cast<std::size_t>(door.room_a) == room ||
                        static_cast<std::size_t>(door.room_b) == room;
      doors += here ? 1 : 0;
    }
  }
  return doors;
}

class Ventilator {
 public:
  Ventilator(const FloorPlan& plan, Rng& rng) : plan_(plan), rng_(rng) {}

  std::optional<Ventilation> Draw() {
    // Of all inlets: what doors can take without a gale in them.
    constexpr double kMaxFlow_m2_per_s = 4.5;
    const int inlets = DrawInt(rng_, 1, 2);
    for (int i = 0; i < inlets; ++i) {
      if (!AddInlet(kMaxFlow_m2_per_s / inlets)) return std::nullopt;
    }
    if (!ChooseFreshRoom()) return std::nullopt;
    const int outlets = DrawInt(rng_, 1, 3);
    for (int i = 0; i < outlets; ++i) {
      if (!AddOutlet()) return std::nullopt;
    }
    return result_;
  }

 private:
  // Somewhere in the outer wall and apart from the others; nothing if the draw is not.
  std::optional<Window> DrawWindow() {
    constexpr int kMargin = 2;  // to the corners of the room
    Window window;
    window.room = rng_.Below(plan_.rooms.size());
    window.side = static_cast<Side>(rng_.Below(4));
    window.width = DrawInt(rng_, 4, 9);  // 0.8 to 1.8 m
    const CellRect& floor = plan_.rooms[window.room].floor;
    const bool along_y = window.side == Side::kWest || window.side == Side::kEast;
    const int low = (along_y ? floor.min.y : floor.min.x) + kMargin;
    const int high = (along_y ? floor.end.y : floor.end.x) - kMargin - window.width;
    if (high < low || !IsOuter(plan_, floor, window.side)) return std::nullopt;
    window.from = DrawInt(rng_, low, high);
    window.zone = ZoneOf(floor, window.side, window.from, window.width);
    const bool apart = std::none_of(
        result_.windows.begin(), result_.windows.end(),
        [&](const Window& other) { return other.zone.Grown(kApart).Overlaps(window.zone); });
    return apart ? std::optional(window) : std::nullopt;
  }

  bool AddInlet(double max_flow_m2_per_s) {
    for (int i = 0; i < kTries; ++i) {
      std::optional<Window> window = DrawWindow();
      const double speed_mps = DrawInt(rng_, 5, 30) / 10.0;  // 0.5 to 3 m/s
      if (!window || speed_mps * window->width / kUnitsPerM > max_flow_m2_per_s) continue;
      window->inflow_mps = speed_mps;
      result_.windows.push_back(*window);
      return true;
    }
    return false;
  }

  // The only room with an inlet, or one where all that enters leaves by its one door.
  bool ChooseFreshRoom() {
    const std::vector<Window>& inlets = result_.windows;
    const std::size_t first = rng_.Below(inlets.size());
    for (std::size_t i = 0; i < inlets.size(); ++i) {
      const std::size_t room = inlets[(first + i) % inlets.size()].room;
      const bool only = std::all_of(inlets.begin(), inlets.end(),
                                    [room](const Window& inlet) { return inlet.room == room; });
      result_.fresh_room = room;
      if (only || DoorsOf(plan_, room) == 1) return true;
    }
    return false;
  }

  // Of several draws the one farthest from the inlets.
  bool AddOutlet() {
    constexpr int kCompared = 4;
    std::optional<Window> best;
    int best_distance = std::min(plan_.width, plan_.height) / 3;
    for (int i = 0, compared = 0; i < kTries && compared < kCompared; ++i) {
      const std::optional<Window> window = DrawWindow();
      if (!window) continue;
      ++compared;
      const int distance = DistanceToInlets(*window);
      if (distance <= best_distance) continue;
      best = window;
      best_distance = distance;
    }
    if (best) result_.windows.push_back(*best);
    return best.has_value();
  }

  // 0 in a room with an inlet: air that leaves there passes no other room.
  int DistanceToInlets(const Window& window) const {
    int nearest = std::numeric_limits<int>::max();
    for (const Window& inlet : result_.windows) {
      if (!inlet.inflow_mps) continue;
      nearest =
          std::min(nearest, inlet.room == window.room ? 0 : Distance(inlet.zone, window.zone));
    }
    return nearest;
  }

  const FloorPlan& plan_;
  Rng& rng_;
  Ventilation result_;
};

}  // namespace

double Ventilation::Flow_m2_per_s() const {
  double flow = 0.0;
  for (const Window& window : windows) {
    flow += window.inflow_mps.value_or(0.0) * window.width / kUnitsPerM;
  }
  return flow;
}

std::optional<Ventilation> DrawVentilation(const FloorPlan& plan, Rng& rng) {
  return Ventilator(plan, rng).Draw();
}

}  // namespace plumescout::lab
