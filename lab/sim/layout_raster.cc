// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout_raster.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "core/grid/flood.h"
#include "core/types/status_macros.h"
#include "lab/sim/fan_raster.h"

namespace plumescout::lab {
namespace {

// Cell centres lie half a cell off the grid lines on which layouts are drawn; this much of a metre
// decides for those that lie on an edge up to rounding.
constexpr double kEdge_m = 1e-9;

GridGeometry GeometryOf(const Layout& layout) {
  GridGeometry geometry;
  geometry.resolution_m = layout.resolution_m;
  geometry.width = static_cast<int>(std::ceil(layout.size_x_m / layout.resolution_m - kEdge_m));
  geometry.height = static_cast<int>(std::ceil(layout.size_y_m / layout.resolution_m - kEdge_m));
  return geometry;
}

int BorderCells(const Layout& layout) {
  return static_cast<int>(std::lround(layout.border_m / layout.resolution_m));
}

bool InBorder(const GridGeometry& geometry, Cell cell, int border_cells) {
  return cell.x < border_cells || cell.y < border_cells ||
         cell.x >= geometry.width - border_cells || cell.y >= geometry.height - border_cells;
}

bool Covers(const Wall& wall, Point2 point) {
  const double length_m = Distance_m(wall.from, wall.to);
  const double east = (wall.to.x_m - wall.from.x_m) / length_m;
  const double north = (wall.to.y_m - wall.from.y_m) / length_m;
  const double x = point.x_m - wall.from.x_m;
  const double y = point.y_m - wall.from.y_m;
  const double along_m = x * east + y * north;
  const double half_m = wall.thickness_m / 2.0 - kEdge_m;
  if (std::abs(y * east - x * north) > half_m) return false;
  if (along_m < -half_m || along_m > length_m + half_m) return false;
  return std::none_of(wall.doors.begin(), wall.doors.end(), [along_m](const Door& door) {
    return std::abs(along_m - door.at_m) < door.width_m / 2.0 - kEdge_m;
  });
}

bool Covers(const Rectangle& box, Point2 point) { return box.Grown(-kEdge_m).Surrounds(point); }

Grid<std::uint8_t> OpenCells(const Layout& layout) {
  const GridGeometry geometry = GeometryOf(layout);
  Grid<std::uint8_t> open(geometry, 1);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Cell cell = geometry.CellAtIndex(i);
    const Point2 center = geometry.Center(cell);
    const auto covers = [center](const auto& solid) { return Covers(solid, center); };
    const bool solid = InBorder(geometry, cell, BorderCells(layout)) ||
                       std::any_of(layout.walls.begin(), layout.walls.end(), covers) ||
                       std::any_of(layout.boxes.begin(), layout.boxes.end(), covers);
    open[i] = solid ? 0 : 1;
  }
  return open;
}

// Cell `along` the side, `depth` cells in from the outside.
Cell CellAtSide(const GridGeometry& geometry, Side side, int along, int depth) {
  switch (side) {
    case Side::kWest:
      return {depth, along};
    case Side::kEast:
      return {geometry.width - 1 - depth, along};
    case Side::kSouth:
      return {along, depth};
    case Side::kNorth:
      return {along, geometry.height - 1 - depth};
  }
  return {};
}

// Turns the cells of the outer wall behind `opening` to air. `field` is its name in errors.
absl::Status CutOpening(const std::string& field, const Opening& opening, int border_cells,
                        FlowDomain& flow) {
  const GridGeometry& geometry = flow.fluid.geometry();
  const int first = static_cast<int>(std::lround(opening.from_m / geometry.resolution_m));
  const int end = static_cast<int>(std::lround(opening.to_m / geometry.resolution_m));
  bool passes = false;
  for (int along = first; along < end; ++along) {
    const Cell outer = CellAtSide(geometry, opening.side, along, 0);
    if (flow.fluid[outer] != 0) {
      return absl::InvalidArgumentError(field + " overlaps another opening");
    }
    for (int depth = 0; depth < border_cells; ++depth) {
      flow.fluid[CellAtSide(geometry, opening.side, along, depth)] = 1;
    }
    flow.openings.push_back({outer, opening.side, opening.inflow_mps});
    passes |= flow.fluid[CellAtSide(geometry, opening.side, along, border_cells)] != 0;
  }
  if (passes) return absl::OkStatus();
  return absl::InvalidArgumentError(field + " leads into a wall");
}

absl::Status CutOpenings(const Layout& layout, FlowDomain& flow) {
  bool inlet = false;
  bool outlet = false;
  for (std::size_t i = 0; i < layout.openings.size(); ++i) {
    const Opening& opening = layout.openings[i];
    (opening.inflow_mps ? inlet : outlet) = true;
    PLUMESCOUT_RETURN_IF_ERROR(
        CutOpening(absl::StrCat("openings[", i, "]"), opening, BorderCells(layout), flow));
  }
  const bool blown = inlet || !layout.fans.empty();
  if (layout.openings.empty() || (blown && outlet)) return absl::OkStatus();
  return absl::InvalidArgumentError(
      blown ? "openings must include an outlet, one without inflow_mps"
            : "openings must include an inlet, one with inflow_mps; without openings air rests");
}

absl::Status CheckOpen(const std::string& field, Point2 point, const Grid<std::uint8_t>& open,
                       const Grid<std::uint8_t>& reachable) {
  const Cell cell = open.geometry().CellAt(point);
  if (reachable.At(cell, 0) != 0) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(field, " (", point.x_m, ", ", point.y_m, ") ",
                   open.At(cell, 0) != 0 ? "is cut off from the start" : "lies in a wall or box"));
}

}  // namespace

absl::StatusOr<LayoutRaster> Rasterize(const Layout& layout) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(layout));
  const Grid<std::uint8_t> open = OpenCells(layout);
  const Cell start = open.geometry().CellAt(layout.start_pose.position());
  const Grid<std::uint8_t> reachable = ReachableCells(open, {start}, Connectivity::kFour);
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckOpen("start_pose", layout.start_pose.position(), open, reachable));
  for (std::size_t i = 0; i < layout.sources.size(); ++i) {
    const GasSource& source = layout.sources[i];
    PLUMESCOUT_RETURN_IF_ERROR(
        CheckOpen(absl::StrCat("sources[", i, "]"), {source.x_m, source.y_m}, open, reachable));
  }
  LayoutRaster raster;
  raster.flow.fluid = reachable;
  PLUMESCOUT_RETURN_IF_ERROR(CutOpenings(layout, raster.flow));
  PLUMESCOUT_RETURN_IF_ERROR(AddFans(layout.fans, raster.flow));
  raster.occupancy = Grid<CellState>(open.geometry(), CellState::kOccupied);
  for (std::size_t i = 0; i < reachable.size(); ++i) {
    if (reachable[i] != 0) raster.occupancy[i] = CellState::kFree;
  }
  return raster;
}

}  // namespace plumescout::lab
