// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout.h"

#include <cmath>

#include "absl/strings/str_cat.h"
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

struct Range {
  double low;
  double high;
  bool low_included = true;
};

// NaN is in no range.
absl::Status Check(const std::string& field, double value, const Range& range) {
  const bool above = range.low_included ? value >= range.low : value > range.low;
  if (above && value <= range.high) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(field, " = ", value, " must be in ",
                                                 range.low_included ? "[" : "(", range.low, ", ",
                                                 range.high, "]"));
}

constexpr Range Positive(double high) { return {0.0, high, false}; }
constexpr Range NotNegative(double high) { return {0.0, high, true}; }

absl::Status CheckInside(const std::string& field, Point2 point, const Layout& layout) {
  PLUMESCOUT_RETURN_IF_ERROR(Check(absl::StrCat(field, "[0]"), point.x_m, {0.0, layout.size_x_m}));
  return Check(absl::StrCat(field, "[1]"), point.y_m, {0.0, layout.size_y_m});
}

absl::Status CheckFrame(const Layout& layout) {
  if (layout.name.empty()) return absl::InvalidArgumentError("name must not be empty");
  PLUMESCOUT_RETURN_IF_ERROR(Check("size_m[0]", layout.size_x_m, Positive(kMaxSize_m)));
  PLUMESCOUT_RETURN_IF_ERROR(Check("size_m[1]", layout.size_y_m, Positive(kMaxSize_m)));
  PLUMESCOUT_RETURN_IF_ERROR(
      Check("resolution_m", layout.resolution_m, {kMinResolution_m, kMaxResolution_m}));
  PLUMESCOUT_RETURN_IF_ERROR(
      Check("border_m", layout.border_m, {layout.resolution_m, kMaxThickness_m}));
  PLUMESCOUT_RETURN_IF_ERROR(
      Check("sensor_height_m", layout.sensor_height_m, NotNegative(kMaxDepth_m)));
  PLUMESCOUT_RETURN_IF_ERROR(
      Check("critical_threshold_ppm", layout.critical_threshold_ppm, Positive(kMaxRate_ppm_per_s)));
  const double cells =
      layout.size_x_m / layout.resolution_m * (layout.size_y_m / layout.resolution_m);
  return Check("cells", cells, {1.0, kMaxCells});
}

absl::Status CheckDoor(const std::string& wall, const std::vector<Door>& doors, std::size_t index,
                       double wall_m) {
  const std::string field = absl::StrCat(wall, ".doors[", index, "]");
  const Door& door = doors[index];
  PLUMESCOUT_RETURN_IF_ERROR(Check(field + ".width_m", door.width_m, Positive(wall_m)));
  const double half_m = door.width_m / 2.0;
  PLUMESCOUT_RETURN_IF_ERROR(
      Check(field + ".at_m", door.at_m, {half_m - kTouch_m, wall_m - half_m + kTouch_m}));
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
  PLUMESCOUT_RETURN_IF_ERROR(
      Check(field + ".thickness_m", wall.thickness_m, Positive(kMaxThickness_m)));
  const double length_m = Distance_m(wall.from, wall.to);
  PLUMESCOUT_RETURN_IF_ERROR(Check(field + ".length_m", length_m, Positive(2.0 * kMaxSize_m)));
  for (std::size_t i = 0; i < wall.doors.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckDoor(field, wall.doors, i, length_m));
  }
  return absl::OkStatus();
}

bool Overlap(const Rectangle& a, const Rectangle& b) {
  return a.min.x_m < b.max.x_m - kTouch_m && b.min.x_m < a.max.x_m - kTouch_m &&
         a.min.y_m < b.max.y_m - kTouch_m && b.min.y_m < a.max.y_m - kTouch_m;
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
  PLUMESCOUT_RETURN_IF_ERROR(Check(field + ".from_m", opening.from_m, {layout.border_m, end_m}));
  PLUMESCOUT_RETURN_IF_ERROR(Check(field + ".to_m", opening.to_m, {opening.from_m, end_m, false}));
  if (!opening.inflow_mps) return absl::OkStatus();
  return Check(field + ".inflow_mps", *opening.inflow_mps, Positive(kMaxAir_mps));
}

absl::Status CheckFan(const std::string& field, const Fan& fan, const Layout& layout) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckInside(field + ".position_m", fan.position, layout));
  PLUMESCOUT_RETURN_IF_ERROR(
      Check(field + ".direction_rad", fan.direction_rad, {-2.0 * M_PI, 2.0 * M_PI}));
  PLUMESCOUT_RETURN_IF_ERROR(Check(field + ".width_m", fan.width_m, Positive(kMaxSize_m)));
  return Check(field + ".speed_mps", fan.speed_mps, Positive(kMaxAir_mps));
}

absl::Status CheckSources(const Layout& layout) {
  if (layout.sources.empty()) return absl::InvalidArgumentError("sources must not be empty");
  for (std::size_t i = 0; i < layout.sources.size(); ++i) {
    const GasSource& source = layout.sources[i];
    const std::string field = absl::StrCat("sources[", i, "]");
    PLUMESCOUT_RETURN_IF_ERROR(
        CheckInside(field + ".position_m", {source.x_m, source.y_m}, layout));
    PLUMESCOUT_RETURN_IF_ERROR(
        Check(field + ".rate_ppm_per_s", source.rate_ppm_per_s, Positive(kMaxRate_ppm_per_s)));
    const absl::Status release = Validate(source.release);
    if (release.ok()) continue;
    return absl::InvalidArgumentError(absl::StrCat(field, ".release.", release.message()));
  }
  return absl::OkStatus();
}

absl::Status CheckGas(const GasParameters& gas) {
  PLUMESCOUT_RETURN_IF_ERROR(
      Check("gas.filaments_per_s", gas.filaments_per_s, {1.0, kMaxFilaments_per_s}));
  PLUMESCOUT_RETURN_IF_ERROR(
      Check("gas.initial_sigma_m", gas.initial_sigma_m, Positive(kMaxSigma_m)));
  PLUMESCOUT_RETURN_IF_ERROR(
      Check("gas.growth_m2_per_s", gas.growth_m2_per_s, NotNegative(kMaxSpreading_m2_per_s)));
  PLUMESCOUT_RETURN_IF_ERROR(Check("gas.diffusivity_m2_per_s", gas.diffusivity_m2_per_s,
                                   NotNegative(kMaxSpreading_m2_per_s)));
  return Check("gas.mixing_depth_m", gas.mixing_depth_m, Positive(kMaxDepth_m));
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
      if (!Overlap(layout.boxes[j], layout.boxes[i])) continue;
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
      Check("start_pose.yaw_rad", layout.start_pose.yaw_rad, {-2.0 * M_PI, 2.0 * M_PI}));
  return CheckGas(layout.gas);
}

}  // namespace plumescout::lab
