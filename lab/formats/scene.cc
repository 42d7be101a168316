// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

// In the order of Side.
constexpr absl::string_view kSideNames[] = {"west", "east", "south", "north"};

absl::Status Invalid(const std::string& what) { return absl::InvalidArgumentError(what); }

absl::Status ValidateRaster(const Grid<float>& raster, const Scene& scene, absl::string_view name,
                            float lowest) {
  if (raster.geometry() != scene.geometry() || raster.size() != scene.geometry().size()) {
    return Invalid(absl::StrCat(name, " has another geometry than the occupancy"));
  }
  for (std::size_t i = 0; i < raster.size(); ++i) {
    if (std::isfinite(raster[i]) && raster[i] >= lowest) continue;
    const Cell cell = raster.geometry().CellAtIndex(i);
    return Invalid(absl::StrCat(name, " = ", raster[i], " in cell (", cell.x, ", ", cell.y,
                                ") must be ", lowest == 0.0F ? "finite and >= 0" : "finite"));
  }
  return absl::OkStatus();
}

absl::Status ValidateRasters(const Scene& scene) {
  constexpr float kAnyFinite = std::numeric_limits<float>::lowest();
  PLUMESCOUT_RETURN_IF_ERROR(ValidateRaster(scene.conc_mean_ppm, scene, "conc_mean_ppm", 0.0F));
  PLUMESCOUT_RETURN_IF_ERROR(ValidateRaster(scene.conc_std_ppm, scene, "conc_std_ppm", 0.0F));
  if (scene.conc_mean_by_source_ppm.size() != scene.sources.size()) {
    return Invalid("conc_mean_by_source_ppm must have one layer per source");
  }
  for (const Grid<float>& layer : scene.conc_mean_by_source_ppm) {
    PLUMESCOUT_RETURN_IF_ERROR(ValidateRaster(layer, scene, "conc_mean_by_source_ppm", 0.0F));
  }
  if (!scene.wind) return absl::OkStatus();
  PLUMESCOUT_RETURN_IF_ERROR(ValidateRaster(scene.wind->u_mps, scene, "wind.u_mps", kAnyFinite));
  return ValidateRaster(scene.wind->v_mps, scene, "wind.v_mps", kAnyFinite);
}

absl::Status ValidateSeries(const Scene& scene) {
  const ConcentrationSeries& series = scene.series;
  PLUMESCOUT_RETURN_IF_ERROR(Checker()
                                 .Positive("dt_s", series.dt_s)
                                 .Positive("scale_ppm_per_count", series.scale_ppm_per_count)
                                 .status());
  const bool filled =
      series.frames > 0 &&
      series.counts.size() == static_cast<std::uint64_t>(series.frames) * scene.geometry().size();
  if (filled) return absl::OkStatus();
  return Invalid(absl::StrCat("series.counts holds ", series.counts.size(), " values, not ",
                              series.frames, " frames x ", scene.geometry().height, " x ",
                              scene.geometry().width));
}

absl::Status ValidateSource(const GasSource& source) {
  const bool finite = std::isfinite(source.x_m) && std::isfinite(source.y_m) &&
                      std::isfinite(source.z_m) && std::isfinite(source.rate_ppm_per_s);
  if (!finite || source.rate_ppm_per_s < 0.0) {
    return Invalid(absl::StrCat("source ", source.id, " is not finite or its rate negative"));
  }
  const absl::Status release = Validate(source.release);
  if (release.ok()) return release;
  return Invalid(absl::StrCat("source ", source.id, ": release.", release.message()));
}

// The part of `opening` that another one overlaps, or its place, is named.
absl::Status ValidateOpening(const Scene& scene, std::size_t index) {
  const Opening& opening = scene.openings[index];
  const std::string field = absl::StrCat("openings[", index, "]");
  const GridGeometry& geometry = scene.geometry();
  const bool along_x = opening.side == Side::kSouth || opening.side == Side::kNorth;
  const double low_m = along_x ? geometry.origin_x_m : geometry.origin_y_m;
  const double high_m =
      low_m + (along_x ? geometry.width : geometry.height) * geometry.resolution_m;
  const double slack_m = geometry.resolution_m;  // decimals may be rounded
  if (!(opening.from_m >= low_m - slack_m && opening.from_m < opening.to_m &&
        opening.to_m <= high_m + slack_m)) {
    return Invalid(absl::StrCat(field, " from ", opening.from_m, " to ", opening.to_m,
                                " m must rise within the wall, [", low_m, ", ", high_m, "]"));
  }
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker().Positive(field + ".inflow_mps", opening.inflow_mps.value_or(1.0)).status());
  for (std::size_t i = 0; i < index; ++i) {
    const Opening& other = scene.openings[i];
    const bool apart =
        other.side != opening.side || other.to_m <= opening.from_m || opening.to_m <= other.from_m;
    if (!apart) return Invalid(absl::StrCat(field, " overlaps openings[", i, "]"));
  }
  return absl::OkStatus();
}

absl::Status ValidateStart(const Scene& scene) {
  const Pose2& start = scene.start_pose;
  if (!std::isfinite(start.x_m) || !std::isfinite(start.y_m) || !std::isfinite(start.yaw_rad)) {
    return Invalid("start_pose must be finite");
  }
  const Cell cell = scene.geometry().CellAt(start.position());
  if (scene.occupancy.At(cell, CellState::kOccupied) == CellState::kFree) return absl::OkStatus();
  return Invalid(
      absl::StrCat("start_pose (", start.x_m, ", ", start.y_m, ") is not on a free cell"));
}

}  // namespace

absl::string_view NameOf(Side side) { return kSideNames[static_cast<std::size_t>(side)]; }

std::optional<Side> SideNamed(absl::string_view name) {
  const auto* const found = std::find(std::begin(kSideNames), std::end(kSideNames), name);
  if (found == std::end(kSideNames)) return std::nullopt;
  return static_cast<Side>(found - std::begin(kSideNames));
}

absl::Status ValidateScene(const Scene& scene) {
  const GridGeometry& geometry = scene.geometry();
  const bool sized = geometry.width > 0 && geometry.height > 0 && geometry.resolution_m > 0.0 &&
                     std::isfinite(geometry.resolution_m) && std::isfinite(geometry.origin_x_m) &&
                     std::isfinite(geometry.origin_y_m);
  if (!sized) return Invalid("the geometry is empty or not finite");
  const std::vector<CellState>& states = scene.occupancy.values();
  if (std::find(states.begin(), states.end(), CellState::kUnknown) != states.end()) {
    return Invalid("occupancy must be known everywhere");
  }
  PLUMESCOUT_RETURN_IF_ERROR(ValidateRasters(scene));
  PLUMESCOUT_RETURN_IF_ERROR(ValidateSeries(scene));
  for (const GasSource& source : scene.sources) PLUMESCOUT_RETURN_IF_ERROR(ValidateSource(source));
  if (!(scene.sensor_height_m >= 0.0)) {
    return Invalid(absl::StrCat("sensor_height_m = ", scene.sensor_height_m, " must be >= 0"));
  }
  if (!(scene.critical_threshold_ppm >= 0.0)) {
    return Invalid(
        absl::StrCat("critical_threshold_ppm = ", scene.critical_threshold_ppm, " must be >= 0"));
  }
  for (std::size_t i = 0; i < scene.openings.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(ValidateOpening(scene, i));
  }
  return ValidateStart(scene);
}

double SampleConcentration_ppm(const Scene& scene, Point2 point, double time_s) {
  const GridGeometry& geometry = scene.geometry();
  const Cell cell = geometry.CellAt(point);
  const Cell nearest{std::clamp(cell.x, 0, geometry.width - 1),
                     std::clamp(cell.y, 0, geometry.height - 1)};
  const double last_frame = scene.series.frames - 1;
  const double frame = std::clamp(std::round(time_s / scene.series.dt_s), 0.0, last_frame);
  const std::size_t index =
      static_cast<std::size_t>(frame) * geometry.size() + geometry.Index(nearest);
  return scene.series.counts[index] * scene.series.scale_ppm_per_count;
}

}  // namespace plumescout::lab
