// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout_generator.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/grid/distance_field.h"
#include "core/grid/flood.h"
#include "core/types/rng.h"
#include "lab/sim/floor_plan.h"
#include "lab/sim/furniture.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/ventilation.h"

namespace plumescout::lab {
namespace {

constexpr int kTries = 40;  // to find a place for a leak or the start
constexpr double kRateStep_ppm_per_s = 50.0;
constexpr int kMinRate_steps = 12;
constexpr int kUsualRate_steps = 16;
constexpr int kMaxRate_steps = 40;  // 600, 800 and 2000 ppm/s

struct Spot {
  int x = 0;
  int y = 0;
};

int Distance(const Spot& a, const Spot& b) { return std::abs(a.x - b.x) + std::abs(a.y - b.y); }

Spot MiddleOf(const CellRect& rect) {
  return {(rect.min.x + rect.end.x) / 2, (rect.min.y + rect.end.y) / 2};
}

// The door's gap.
CellRect GapOf(const Partition& wall, const PlanDoor& door) {
  CellRect gap = wall.solid;
  (wall.vertical ? gap.min.y : gap.min.x) = door.from;
  (wall.vertical ? gap.end.y : gap.end.x) = door.from + door.width;
  return gap;
}

struct Leak {
  Spot spot;
  std::size_t room = 0;
  double rate_ppm_per_s = 0.0;
};

// Furnishes a ventilated building and puts leaks and the start into it.
class Interior {
 public:
  Interior(const FloorPlan& plan, const Ventilation& air, Rng& rng)
      : plan_(plan), air_(air), rng_(rng) {}

  // Whether all found a place.
  bool Draw(int max_leaks) {
    std::vector<CellRect> clear = DoorZones();
    for (const Window& window : air_.windows) clear.push_back(window.zone);
    furniture_ = DrawFurniture(plan_, clear, rng_);
    return DrawLeaks(max_leaks) && DrawStart();
  }

  const std::vector<CellRect>& furniture() const { return furniture_; }
  const std::vector<Leak>& leaks() const { return leaks_; }
  const Spot& start() const { return start_; }

 private:
  // Kept clear on both sides of doors.
  std::vector<CellRect> DoorZones() const {
    constexpr int kDepth = 6;  // 1.2 m
    std::vector<CellRect> zones;
    for (const Partition& wall : plan_.partitions) {
      for (const PlanDoor& door : wall.doors) {
        CellRect zone = GapOf(wall, door);
        (wall.vertical ? zone.min.x : zone.min.y) -= kDepth;
        (wall.vertical ? zone.end.x : zone.end.y) += kDepth;
        zones.push_back(zone);
      }
    }
    return zones;
  }

  // A spot in the open of this room; nothing if furniture is in the way of the draw.
  std::optional<Spot> DrawSpot(const CellRect& floor) {
    constexpr int kClearance = 3;  // 0.6 m
    const int x = DrawInt(rng_, floor.min.x + kClearance, floor.end.x - kClearance);
    const int y = DrawInt(rng_, floor.min.y + kClearance, floor.end.y - kClearance);
    const CellRect around = CellRect{{x, y}, {x, y}}.Grown(kClearance);
    const auto overlaps = [&around](const CellRect& rect) { return rect.Overlaps(around); };
    if (std::any_of(furniture_.begin(), furniture_.end(), overlaps)) return std::nullopt;
    return Spot{x, y};
  }

  // As many as the air can carry off: once mixed with all of it they make this much on average.
  // Above it most of the building turns critical.
  bool DrawLeaks(int max_leaks) {
    constexpr double kMixed_ppm = 7.0;
    constexpr double kDepth_m = 2.05;            // GasParameters::mixing_depth_m
    constexpr double kRelease_m3 = 0.015749610;  // (2 pi)^(3/2) sigma_0^3, of GasParameters
    const double carried_ppm_per_s = kMixed_ppm * kDepth_m * air_.Flow_m2_per_s() / kRelease_m3;
    const int carried = static_cast<int>(carried_ppm_per_s / kRateStep_ppm_per_s);
    const int count = DrawInt(rng_, 1, std::clamp(carried / kUsualRate_steps, 1, max_leaks));
    const int high = std::clamp(carried / count, kMinRate_steps, kMaxRate_steps);
    for (int i = 0; i < count; ++i) {
      if (!AddLeak(kRateStep_ppm_per_s * DrawInt(rng_, kMinRate_steps, high))) return false;
    }
    return true;
  }

  // Apart from the others and from windows, not in the fresh room.
  bool AddLeak(double rate_ppm_per_s) {
    constexpr int kApart = 3 * kUnitsPerM;
    for (int i = 0; i < kTries; ++i) {
      const std::size_t room = rng_.Below(plan_.rooms.size());
      if (room == air_.fresh_room) continue;
      const std::optional<Spot> spot = DrawSpot(plan_.rooms[room].floor);
      if (!spot) continue;
      const bool apart = std::none_of(leaks_.begin(), leaks_.end(), [&](const Leak& other) {
        return Distance(other.spot, *spot) < kApart;
      });
      const bool away =
          std::none_of(air_.windows.begin(), air_.windows.end(), [&](const Window& window) {
            return Distance(MiddleOf(window.zone), *spot) < kApart / 2;
          });
      if (!apart || !away) continue;
      leaks_.push_back({*spot, room, rate_ppm_per_s});
      return true;
    }
    return false;
  }

  bool DrawStart() {
    for (int i = 0; i < kTries; ++i) {
      const std::optional<Spot> spot = DrawSpot(plan_.rooms[air_.fresh_room].floor);
      if (!spot || !IsClean(*spot)) continue;
      start_ = *spot;
      return true;
    }
    return false;
  }

  // Gas seeps through the doors of rooms with a leak, against the wind too.
  bool IsClean(const Spot& spot) const {
    constexpr int kReach = 3 * kUnitsPerM;
    for (const Partition& wall : plan_.partitions) {
      for (const PlanDoor& door : wall.doors) {
        const auto a = static_cast<std::size_t>(door.room_a);
        const auto b = static_cast<std::size_t>(door.room_b);
        const bool seeps =
            (a == air_.fresh_room && HasLeak(b)) || (b == air_.fresh_room && HasLeak(a));
        if (seeps && Distance(MiddleOf(GapOf(wall, door)), spot) < kReach) return false;
      }
    }
    return true;
  }

  bool HasLeak(std::size_t room) const {
    return std::any_of(leaks_.begin(), leaks_.end(),
                       [room](const Leak& leak) { return leak.room == room; });
  }

  const FloorPlan& plan_;
  const Ventilation& air_;
  Rng& rng_;
  std::vector<CellRect> furniture_;
  std::vector<Leak> leaks_;
  Spot start_;
};

// Quotients, so that they are the doubles nearest to the decimals.
double Meters(int units) { return static_cast<double>(units) / kUnitsPerM; }
double HalfMeters(int half_units) { return static_cast<double>(half_units) / (2 * kUnitsPerM); }

Wall ToWall(const Partition& partition) {
  const CellRect& solid = partition.solid;
  Wall wall;
  wall.thickness_m = Meters(1);
  if (partition.vertical) {
    wall.from = {HalfMeters(solid.min.x + solid.end.x), Meters(solid.min.y)};
    wall.to = {HalfMeters(solid.min.x + solid.end.x), Meters(solid.end.y)};
  } else {
    wall.from = {Meters(solid.min.x), HalfMeters(solid.min.y + solid.end.y)};
    wall.to = {Meters(solid.end.x), HalfMeters(solid.min.y + solid.end.y)};
  }
  const int begin = partition.vertical ? solid.min.y : solid.min.x;
  for (const PlanDoor& door : partition.doors) {
    wall.doors.push_back({HalfMeters(2 * (door.from - begin) + door.width), Meters(door.width)});
  }
  return wall;
}

Layout ToLayout(const FloorPlan& plan, const Ventilation& air, const Interior& interior) {
  Layout layout;
  layout.size_x_m = Meters(plan.width);
  layout.size_y_m = Meters(plan.height);
  layout.border_m = Meters(1);
  for (const Partition& partition : plan.partitions) layout.walls.push_back(ToWall(partition));
  for (const CellRect& piece : interior.furniture()) {
    layout.boxes.push_back(
        {{Meters(piece.min.x), Meters(piece.min.y)}, {Meters(piece.end.x), Meters(piece.end.y)}});
  }
  for (const Window& window : air.windows) {
    layout.openings.push_back(
        {window.side, Meters(window.from), Meters(window.from + window.width), window.inflow_mps});
  }
  for (const Leak& leak : interior.leaks()) {
    GasSource source;
    source.id = static_cast<int>(layout.sources.size());
    source.x_m = Meters(leak.spot.x);
    source.y_m = Meters(leak.spot.y);
    source.z_m = layout.sensor_height_m;
    source.rate_ppm_per_s = leak.rate_ppm_per_s;
    layout.sources.push_back(source);
  }
  layout.start_pose.x_m = Meters(interior.start().x);
  layout.start_pose.y_m = Meters(interior.start().y);
  return layout;
}

// From few large halls to many small rooms, at least about three.
FloorPlanStyle DrawStyle(int width, int height, Rng& rng) {
  constexpr int kRoomArea_m2 = 14;
  constexpr int kHallArea_m2 = 110;
  FloorPlanStyle style;
  const int largest = DrawInt(rng, kRoomArea_m2, kHallArea_m2) * kUnitsPerM * kUnitsPerM;
  style.largest_room_units2 = std::min(largest, width * height / 3);
  style.corridor_share = rng.Uniform01();
  style.loop_share = rng.Uniform(0.1, 0.5);
  return style;
}

// Whether the free cells a robot's radius off everything are one space.
bool SuitsARobot(const Layout& layout) {
  constexpr double kRadius_m = 0.2;  // [XIT] Table I, inflation
  const absl::StatusOr<LayoutRaster> raster = Rasterize(layout);
  if (!raster.ok()) return false;
  const Grid<CellState>& occupancy = raster->occupancy;
  Grid<std::uint8_t> occupied(occupancy.geometry());
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = occupancy[i] == CellState::kOccupied ? 1 : 0;
  }
  const double radius_cells = kRadius_m / layout.resolution_m;
  const Grid<std::int32_t> distance = SquaredDistances_cells2(occupied);
  Grid<std::uint8_t> traversable(occupancy.geometry());
  for (std::size_t i = 0; i < traversable.size(); ++i) {
    traversable[i] = distance[i] > radius_cells * radius_cells ? 1 : 0;
  }
  const Cell start = occupancy.geometry().CellAt(layout.start_pose.position());
  return ReachableCells(traversable, {start}, Connectivity::kFour) == traversable;
}

std::optional<Layout> TryLayout(const std::string& name, const GeneratorOptions& options,
                                Rng& rng) {
  const auto draw_side = [&rng, &options](int max_m) {
    return DrawInt(rng, options.min_size_m * kUnitsPerM, max_m * kUnitsPerM);
  };
  const int width = draw_side(options.max_size_x_m);
  const int height = draw_side(options.max_size_y_m);
  const FloorPlanStyle style = DrawStyle(width, height, rng);
  const std::optional<FloorPlan> plan = DrawFloorPlan(width, height, style, rng);
  if (!plan || plan->rooms.size() < 2) return std::nullopt;
  const std::optional<Ventilation> air = DrawVentilation(*plan, rng);
  if (!air) return std::nullopt;
  Interior interior(*plan, *air, rng);
  if (!interior.Draw(options.max_sources)) return std::nullopt;
  Layout layout = ToLayout(*plan, *air, interior);
  layout.name = name;
  layout.start_pose.yaw_rad = DrawInt(rng, -314, 314) / 100.0;
  if (!SuitsARobot(layout)) return std::nullopt;
  return layout;
}

}  // namespace

Layout GenerateLayout(std::uint64_t seed, const GeneratorOptions& options) {
  const std::string name = absl::StrCat("generated_", seed);
  Rng rng(seed);
  while (true) {  // one draw in some suits
    if (std::optional<Layout> layout = TryLayout(name, options, rng)) return *std::move(layout);
  }
}

}  // namespace plumescout::lab
