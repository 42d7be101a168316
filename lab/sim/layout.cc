// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr double kMaxSize_m = 200.0;
constexpr double kMinResolution_m = 0.02;
constexpr double kMaxResolution_m = 1.0;
constexpr double kMaxCells = 1e6;  // the pressure equation of more would take minutes to factorise
constexpr double kMaxThickness_m = 10.0;
constexpr double kMaxAir_mps = 30.0;        // a storm; air at speeds where it is incompressible
constexpr double kMaxRate_ppm_per_s = 1e6;  // pure gas
constexpr double kMaxFilaments_per_s = 1000.0;
constexpr double kMaxSigma_m = 5.0;
constexpr double kMaxSpreading_m2_per_s = 1.0;
constexpr double kMaxDepth_m = 100.0;
constexpr double kTouch_m = 1e-9;  // by which things may overlap: sums of decimals are rounded

absl::Status CheckInside(const std::string& field, Point2 point, const Layout& layout) {
  return Checker()
      .InRange(field + "[0]", point.x_m, 0.0, layout.size_x_m)
      .InRange(field + "[1]", point.y_m, 0.0, layout.size_y_m)
      .status();
}

absl::Status CheckFrame(const Layout& layout) {
  if (layout.name.empty()) return absl::InvalidArgumentError("name must not be empty");
  const double cells =
      layout.size_x_m / layout.resolution_m * (layout.size_y_m / layout.resolution_m);
  return Checker()
      .InRangeAbove("size_m[0]", layout.size_x_m, 0.0, kMaxSize_m)
      .InRangeAbove("size_m[1]", layout.size_y_m, 0.0, kMaxSize_m)
      .InRange("resolution_m", layout.resolution_m, kMinResolution_m, kMaxResolution_m)
      .InRange("border_m", layout.border_m, layout.resolution_m, kMaxThickness_m)
      .InRange("sensor_height_m", layout.sensor_height_m, 0.0, kMaxDepth_m)
      .InRangeAbove("critical_threshold_ppm", layout.critical_threshold_ppm, 0.0,
                    kMaxRate_ppm_per_s)
      .InRange("cells", cells, 1.0, kMaxCells)
      .status();
}

absl::Status CheckDoor(const std::string& wall, const std::vector<Door>& doors, std::size_t index,
                       double wall_m) {
  const std::string field = absl::StrCat(wall, ".doors[", index, "]");
  const Door& door = doors[index];
  const double half_m = door.width_m / 2.0;
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRangeAbove(field + ".width_m", door.width_m, 0.0, wall_m)
          .InRange(field + ".at_m", door.at_m, half_m - kTouch_m, wall_m - half_m + kTouch_m)
          .status());
  for (std::size_t i = 0; i < index; ++i) {
    const double apart_m = std::abs(doors[i].at_m - door.at_m);
    if (apart_m < half_m + doors[i].width_m / 2.0 - kTouch_m) {
      return absl::InvalidArgumentError(
          absl::StrCat(field, ".at_m = ", door.at_m, " overlaps doors[", i, "]"));
    }
  }
  return absl::OkStatus();
}

absl::Status CheckWall(const std::string& field, const Wall& wall, const Layout& layout) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckInside(field + ".from_m", wall.from, layout));
  PLUMESCOUT_RETURN_IF_ERROR(CheckInside(field + ".to_m", wall.to, layout));
  const double length_m = Distance_m(wall.from, wall.to);
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRangeAbove(field + ".thickness_m", wall.thickness_m, 0.0, kMaxThickness_m)
          .InRangeAbove(field + ".length_m", length_m, 0.0, 2.0 * kMaxSize_m)
          .status());
  for (std::size_t i = 0; i < wall.doors.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckDoor(field, wall.doors, i, length_m));
  }
  return absl::OkStatus();
}

absl::Status CheckBox(const std::string& field, const Rectangle& box, const Layout& layout) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckInside(field + ".min_m", box.min, layout));
  PLUMESCOUT_RETURN_IF_ERROR(CheckInside(field + ".max_m", box.max, layout));
  if (box.min.x_m < box.max.x_m && box.min.y_m < box.max.y_m) return absl::OkStatus();
  return absl::InvalidArgumentError(field + ".min_m must be less than max_m on both axes");
}

absl::Status CheckOpening(const std::string& field, const Opening& opening, const Layout& layout) {
  const bool along_x = opening.side == Side::kSouth || opening.side == Side::kNorth;
  const double end_m = (along_x ? layout.size_x_m : layout.size_y_m) - layout.border_m;
  return Checker()
      .InRange(field + ".from_m", opening.from_m, layout.border_m, end_m)
      .InRangeAbove(field + ".to_m", opening.to_m, opening.from_m, end_m)
      .InRangeAbove(field + ".inflow_mps", opening.inflow_mps.value_or(kMaxAir_mps), 0.0,
                    kMaxAir_mps)
      .status();
}

absl::Status CheckFan(const std::string& field, const Fan& fan, const Layout& layout) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckInside(field + ".position_m", fan.position, layout));
  return Checker()
      .InRange(field + ".direction_rad", fan.direction_rad, -2.0 * M_PI, 2.0 * M_PI)
      .InRangeAbove(field + ".width_m", fan.width_m, 0.0, kMaxSize_m)
      .InRangeAbove(field + ".speed_mps", fan.speed_mps, 0.0, kMaxAir_mps)
      .status();
}

absl::Status CheckSources(const Layout& layout) {
  if (layout.sources.empty()) return absl::InvalidArgumentError("sources must not be empty");
  for (std::size_t i = 0; i < layout.sources.size(); ++i) {
    const GasSource& source = layout.sources[i];
    const std::string field = absl::StrCat("sources[", i, "]");
    PLUMESCOUT_RETURN_IF_ERROR(
        CheckInside(field + ".position_m", {source.x_m, source.y_m}, layout));
    PLUMESCOUT_RETURN_IF_ERROR(
        Checker()
            .InRangeAbove(field + ".rate_ppm_per_s", source.rate_ppm_per_s, 0.0, kMaxRate_ppm_per_s)
            .status());
    const absl::Status release = Validate(source.release);
    if (release.ok()) continue;
    return absl::InvalidArgumentError(absl::StrCat(field, ".release.", release.message()));
  }
  return absl::OkStatus();
}

absl::Status CheckGas(const GasParameters& gas) {
  return Checker()
      .InRange("gas.filaments_per_s", gas.filaments_per_s, 1.0, kMaxFilaments_per_s)
      .InRangeAbove("gas.initial_sigma_m", gas.initial_sigma_m, 0.0, kMaxSigma_m)
      .InRange("gas.growth_m2_per_s", gas.growth_m2_per_s, 0.0, kMaxSpreading_m2_per_s)
      .InRange("gas.diffusivity_m2_per_s", gas.diffusivity_m2_per_s, 0.0, kMaxSpreading_m2_per_s)
      .InRangeAbove("gas.mixing_depth_m", gas.mixing_depth_m, 0.0, kMaxDepth_m)
      .status();
}

}  // namespace

absl::Status Validate(const Layout& layout) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckFrame(layout));
  for (std::size_t i = 0; i < layout.walls.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckWall(absl::StrCat("walls[", i, "]"), layout.walls[i], layout));
  }
  for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckBox(absl::StrCat("boxes[", i, "]"), layout.boxes[i], layout));
    for (std::size_t j = 0; j < i; ++j) {
      if (!layout.boxes[j].Grown(-kTouch_m).Overlaps(layout.boxes[i])) continue;
      const Point2 corner = layout.boxes[i].min;
      return absl::InvalidArgumentError(absl::StrCat("boxes[", i, "] from (", corner.x_m, ", ",
                                                     corner.y_m, ") overlaps boxes[", j, "]"));
    }
  }
  for (std::size_t i = 0; i < layout.openings.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(
        CheckOpening(absl::StrCat("openings[", i, "]"), layout.openings[i], layout));
  }
  for (std::size_t i = 0; i < layout.fans.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckFan(absl::StrCat("fans[", i, "]"), layout.fans[i], layout));
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckSources(layout));
  PLUMESCOUT_RETURN_IF_ERROR(CheckInside("start_pose", layout.start_pose.position(), layout));
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRange("start_pose.yaw_rad", layout.start_pose.yaw_rad, -2.0 * M_PI, 2.0 * M_PI)
          .status());
  return CheckGas(layout.gas);
}

}  // namespace plumescout::lab
