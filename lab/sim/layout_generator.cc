// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout_generator.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>
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

namespace plumescout::lab {
namespace {

constexpr int kClearance = 3;   // of leaks and of the start from solids: 0.6 m
constexpr int kDoorZone = 6;    // kept clear on both sides of a door: 1.2 m
constexpr int kWindowZone = 6;  // and before an opening
constexpr int kTries = 40;      // to find a place for a leak or an opening

struct Spot {
  int x = 0;
  int y = 0;
};

int Distance(const Spot& a, const Spot& b) { return std::abs(a.x - b.x) + std::abs(a.y - b.y); }

// Opening in the outer wall of a room.
struct Window {
  Side side = Side::kWest;
  int from = 0;
  int width = 0;
  std::size_t room = 0;
  UnitRect zone;  // before it, inside

  Spot middle() const { return {(zone.x0 + zone.x1) / 2, (zone.y0 + zone.y1) / 2}; }
};

struct Source {
  Spot spot;
  std::size_t room = 0;
  double rate_ppm_per_s = 0.0;
};

// One attempt at a building.
class Building {
 public:
  Building(FloorPlan plan, Rng& rng) : plan_(std::move(plan)), rng_(rng) {}

  // Whether all found a place.
  bool Fill(const GeneratorOptions& options) {
    if (!DrawWindows()) return false;
    std::vector<UnitRect> clear = DoorZones();
    for (const Window& window : windows_) clear.push_back(window.zone);
    furniture_ = DrawFurniture(plan_, clear, rng_);
    return DrawSources(options.max_sources) && DrawStart();
  }

  Layout ToLayout(std::string name) const;

 private:
  std::vector<UnitRect> DoorZones() const {
    std::vector<UnitRect> zones;
    for (const Partition& wall : plan_.partitions) {
      for (const PlanDoor& door : wall.doors) {
        UnitRect zone = wall.solid;
        (wall.vertical ? zone.y0 : zone.x0) = door.from;
        (wall.vertical ? zone.y1 : zone.x1) = door.from + door.width;
        (wall.vertical ? zone.x0 : zone.y0) -= kDoorZone;
        (wall.vertical ? zone.x1 : zone.y1) += kDoorZone;
        zones.push_back(zone);
      }
    }
    return zones;
  }

  // Somewhere in the outer wall; nothing if the room drawn does not lie at the side drawn.
  std::optional<Window> DrawWindow();
  bool DrawWindows();
  bool AddInlet(double max_flow_m2_per_s);
  // Of several draws the one farthest from the inlets, which sends the air through the building.
  bool AddOutlet();
  bool IsApart(const Window& window) const;
  int DistanceToInlets(const Window& window) const;

  // A spot in the open of this room.
  std::optional<Spot> DrawSpot(const UnitRect& floor);
  bool HasSource(std::size_t room) const;
  bool IsClean(const Spot& spot) const;
  bool DrawStart();
  bool DrawSources(int max_sources);
  bool AddSource();

  FloorPlan plan_;
  Rng& rng_;
  std::vector<Window> windows_;
  std::size_t inlets_ = 0;  // the first ones of windows_
  std::vector<double> inflow_mps_;
  std::vector<UnitRect> furniture_;
  Spot start_;
  std::size_t start_room_ = 0;
  double start_yaw_rad_ = 0.0;
  std::vector<Source> sources_;
};

std::optional<Window> Building::DrawWindow() {
  constexpr int kMargin = 2;
  Window window;
  window.room = rng_.Below(plan_.rooms.size());
  window.side = static_cast<Side>(rng_.Below(4));
  window.width = DrawInt(rng_, 4, 9);  // 0.8 to 1.8 m
  const UnitRect& floor = plan_.rooms[window.room].floor;
  const bool along_y = window.side == Side::kWest || window.side == Side::kEast;
  const int low = (along_y ? floor.y0 : floor.x0) + kMargin;
  const int high = (along_y ? floor.y1 : floor.x1) - kMargin - window.width;
  if (high < low) return std::nullopt;
  window.from = DrawInt(rng_, low, high);
  window.zone = floor;
  (along_y ? window.zone.y0 : window.zone.x0) = window.from;
  (along_y ? window.zone.y1 : window.zone.x1) = window.from + window.width;
  bool outer = false;
  switch (window.side) {
    case Side::kWest:
      outer = floor.x0 == 1;
      window.zone.x1 = floor.x0 + kWindowZone;
      break;
    case Side::kEast:
      outer = floor.x1 == plan_.width - 1;
      window.zone.x0 = floor.x1 - kWindowZone;
      break;
    case Side::kSouth:
      outer = floor.y0 == 1;
      window.zone.y1 = floor.y0 + kWindowZone;
      break;
    case Side::kNorth:
      outer = floor.y1 == plan_.height - 1;
      window.zone.y0 = floor.y1 - kWindowZone;
      break;
  }
  return outer ? std::optional(window) : std::nullopt;
}

bool Building::IsApart(const Window& window) const {
  return std::none_of(windows_.begin(), windows_.end(), [&window](const Window& other) {
    return other.zone.Grown(kPassage_units).Overlaps(window.zone);
  });
}

int Building::DistanceToInlets(const Window& window) const {
  int nearest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < inlets_; ++i) {
    const int distance = Distance(windows_[i].middle(), window.middle());
    // Air that leaves the room it enters passes no other.
    nearest = std::min(nearest, windows_[i].room == window.room ? 0 : distance);
  }
  return nearest;
}

bool Building::AddInlet(double max_flow_m2_per_s) {
  for (int i = 0; i < kTries; ++i) {
    const std::optional<Window> window = DrawWindow();
    const double speed_mps = DrawInt(rng_, 5, 30) / 10.0;
    if (!window || !IsApart(*window)) continue;
    const double width_m = static_cast<double>(window->width) / kUnitsPerM;
    if (speed_mps * width_m > max_flow_m2_per_s) continue;
    windows_.push_back(*window);
    inflow_mps_.push_back(speed_mps);
    ++inlets_;
    return true;
  }
  return false;
}

bool Building::AddOutlet() {
  constexpr int kGood = 4;  // draws that are compared
  const int least = std::min(plan_.width, plan_.height) / 3;
  std::optional<Window> best;
  int best_distance = least;
  for (int i = 0, good = 0; i < kTries && good < kGood; ++i) {
    const std::optional<Window> window = DrawWindow();
    if (!window || !IsApart(*window)) continue;
    ++good;
    const int distance = DistanceToInlets(*window);
    if (distance <= best_distance) continue;
    best = window;
    best_distance = distance;
  }
  if (best) windows_.push_back(*best);
  return best.has_value();
}

bool Building::DrawWindows() {
  // Air through a metre of height: what doors can take without a gale in them.
  constexpr double kMaxFlow_m2_per_s = 3.0;
  const int inlets = DrawInt(rng_, 1, 2);
  for (int i = 0; i < inlets; ++i) {
    if (!AddInlet(kMaxFlow_m2_per_s / inlets)) return false;
  }
  start_room_ = windows_[rng_.Below(inlets_)].room;
  const int outlets = DrawInt(rng_, 1, 3);
  for (int i = 0; i < outlets; ++i) {
    if (!AddOutlet()) return false;
  }
  return true;
}

std::optional<Spot> Building::DrawSpot(const UnitRect& floor) {
  const Spot spot{DrawInt(rng_, floor.x0 + kClearance, floor.x1 - kClearance),
                  DrawInt(rng_, floor.y0 + kClearance, floor.y1 - kClearance)};
  const UnitRect around = UnitRect{spot.x, spot.y, spot.x, spot.y}.Grown(kClearance);
  const auto overlaps = [&around](const UnitRect& rect) { return rect.Overlaps(around); };
  if (std::any_of(furniture_.begin(), furniture_.end(), overlaps)) return std::nullopt;
  return spot;
}

bool Building::HasSource(std::size_t room) const {
  return std::any_of(sources_.begin(), sources_.end(),
                     [&](const Source& source) { return source.room == room; });
}

// Gas seeps through the doors of rooms with a leak, against the wind too.
bool Building::IsClean(const Spot& spot) const {
  constexpr int kReach = 3 * kUnitsPerM;
  for (const Partition& wall : plan_.partitions) {
    for (const PlanDoor& door : wall.doors) {
      const auto a = static_cast<std::size_t>(door.room_a);
      const auto b = static_cast<std::size_t>(door.room_b);
      const bool seeps = (a == start_room_ && HasSource(b)) || (b == start_room_ && HasSource(a));
      const int middle = door.from + door.width / 2;
      const Spot at = wall.vertical ? Spot{wall.solid.x0, middle} : Spot{middle, wall.solid.y0};
      if (seeps && Distance(at, spot) < kReach) return false;
    }
  }
  return true;
}

bool Building::DrawStart() {
  start_yaw_rad_ = DrawInt(rng_, -314, 314) / 100.0;
  for (int i = 0; i < kTries; ++i) {
    const std::optional<Spot> spot = DrawSpot(plan_.rooms[start_room_].floor);
    if (!spot || !IsClean(*spot)) continue;
    start_ = *spot;
    return true;
  }
  return false;
}

bool Building::AddSource() {
  constexpr int kApart = 3 * kUnitsPerM;
  for (int i = 0; i < kTries; ++i) {
    const std::size_t room = rng_.Below(plan_.rooms.size());
    if (room == start_room_) continue;
    const std::optional<Spot> spot = DrawSpot(plan_.rooms[room].floor);
    if (!spot) continue;
    const bool apart = std::none_of(sources_.begin(), sources_.end(), [&](const Source& other) {
      return Distance(other.spot, *spot) < kApart;
    });
    const bool away = std::none_of(windows_.begin(), windows_.end(), [&](const Window& window) {
      return Distance(window.middle(), *spot) < kApart / 2;
    });
    if (!apart || !away) continue;
    sources_.push_back({*spot, room, 50.0 * DrawInt(rng_, 12, 40)});  // 600 to 2000 ppm/s
    return true;
  }
  return false;
}

bool Building::DrawSources(int max_sources) {
  const int count = DrawInt(rng_, 1, max_sources);
  for (int i = 0; i < count; ++i) {
    if (!AddSource()) return false;
  }
  return true;
}

double Meters(int units) { return static_cast<double>(units) / kUnitsPerM; }
Point2 PointAt(int x, int y) { return {Meters(x), Meters(y)}; }

Wall ToWall(const Partition& partition) {
  const UnitRect& solid = partition.solid;
  Wall wall;
  wall.thickness_m = 1.0 / kUnitsPerM;
  // Twice the units are whole numbers at the wall's middle, so that it prints as 3.5, not 3.4999.
  const double middle_m =
      static_cast<double>(2 * (partition.vertical ? solid.x0 : solid.y0) + 1) / (2 * kUnitsPerM);
  if (partition.vertical) {
    wall.from = {middle_m, Meters(solid.y0)};
    wall.to = {middle_m, Meters(solid.y1)};
  } else {
    wall.from = {Meters(solid.x0), middle_m};
    wall.to = {Meters(solid.x1), middle_m};
  }
  const int begin = partition.vertical ? solid.y0 : solid.x0;
  for (const PlanDoor& door : partition.doors) {
    const double at_m =
        static_cast<double>(2 * (door.from - begin) + door.width) / (2 * kUnitsPerM);
    wall.doors.push_back({at_m, Meters(door.width)});
  }
  return wall;
}

Layout Building::ToLayout(std::string name) const {
  Layout layout;
  layout.name = std::move(name);
  layout.size_x_m = Meters(plan_.width);
  layout.size_y_m = Meters(plan_.height);
  layout.border_m = Meters(1);
  for (const Partition& partition : plan_.partitions) layout.walls.push_back(ToWall(partition));
  for (const UnitRect& piece : furniture_) {
    layout.boxes.push_back({PointAt(piece.x0, piece.y0), PointAt(piece.x1, piece.y1)});
  }
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    const Window& window = windows_[i];
    Opening opening{window.side, Meters(window.from), Meters(window.from + window.width), {}};
    if (i < inlets_) opening.inflow_mps = inflow_mps_[i];
    layout.openings.push_back(opening);
  }
  for (const Source& source : sources_) {
    const Point2 at = PointAt(source.spot.x, source.spot.y);
    const int id = static_cast<int>(layout.sources.size());
    layout.sources.push_back({id, at.x_m, at.y_m, layout.sensor_height_m, source.rate_ppm_per_s});
  }
  const Point2 start = PointAt(start_.x, start_.y);
  layout.start_pose = {start.x_m, start.y_m, start_yaw_rad_};
  return layout;
}

// From few large halls to many small rooms, at least three.
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

// The free cells 0.2 m off everything are one space, and not far from all others.
bool SuitsARobot(const Layout& layout) {
  const absl::StatusOr<LayoutRaster> raster = Rasterize(layout);
  if (!raster.ok()) return false;
  const Grid<CellState>& occupancy = raster->occupancy;
  Grid<std::uint8_t> occupied(occupancy.geometry());
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = occupancy[i] == CellState::kOccupied ? 1 : 0;
  }
  const double inflation_cells = 0.2 / layout.resolution_m;
  const Grid<std::int32_t> distance = SquaredDistances_cells2(occupied);
  Grid<std::uint8_t> traversable(occupancy.geometry());
  for (std::size_t i = 0; i < traversable.size(); ++i) {
    traversable[i] = distance[i] > inflation_cells * inflation_cells ? 1 : 0;
  }
  const Cell start = occupancy.geometry().CellAt(layout.start_pose.position());
  return ReachableCells(traversable, {start}, Connectivity::kFour) == traversable;
}

std::optional<Layout> TryLayout(const std::string& name, const GeneratorOptions& options,
                                Rng& rng) {
  const int width =
      DrawInt(rng, options.min_size_m * kUnitsPerM, options.max_size_x_m * kUnitsPerM);
  const int height =
      DrawInt(rng, options.min_size_m * kUnitsPerM, options.max_size_y_m * kUnitsPerM);
  const FloorPlanStyle style = DrawStyle(width, height, rng);
  std::optional<FloorPlan> plan = DrawFloorPlan(width, height, style, rng);
  if (!plan) return std::nullopt;
  Building building(*std::move(plan), rng);
  if (!building.Fill(options)) return std::nullopt;
  Layout layout = building.ToLayout(name);
  if (!SuitsARobot(layout)) return std::nullopt;
  return layout;
}

}  // namespace

Layout GenerateLayout(std::uint64_t seed, const GeneratorOptions& options) {
  const std::string name = absl::StrCat("generated_", seed);
  Rng rng(seed);
  while (true) {  // most draws suit
    if (std::optional<Layout> layout = TryLayout(name, options, rng)) return *std::move(layout);
  }
}

}  // namespace plumescout::lab
