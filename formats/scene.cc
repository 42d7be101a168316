// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

absl::Status Invalid(const std::string& what) { return absl::InvalidArgumentError(what); }

absl::Status ValidateRaster(const Grid<float>& raster, const Scene& scene, absl::string_view name,
                            float lowest) {
  if (raster.geometry() != scene.geometry() || raster.size() != scene.geometry().size()) {
    return Invalid(absl::StrCat(name, " has another geometry than the occupancy"));
  }
  const bool ok = std::all_of(raster.values().begin(), raster.values().end(),
                              [&](float value) { return std::isfinite(value) && value >= lowest; });
  return ok ? absl::OkStatus() : Invalid(absl::StrCat(name, " holds a value out of range"));
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
  if (!(series.dt_s > 0.0 && std::isfinite(series.dt_s))) return Invalid("dt_s must be > 0");
  if (!(series.scale_ppm_per_count > 0.0 && std::isfinite(series.scale_ppm_per_count))) {
    return Invalid("scale_ppm_per_count must be > 0");
  }
  const bool filled =
      series.frames > 0 &&
      series.counts.size() == static_cast<std::uint64_t>(series.frames) * scene.geometry().size();
  return filled ? absl::OkStatus() : Invalid("series.counts must hold frames x height x width");
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
  if (!(scene.sensor_height_m >= 0.0) || !(scene.critical_threshold_ppm >= 0.0)) {
    return Invalid("sensor_height_m and critical_threshold_ppm must be >= 0");
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

}  // namespace plumescout
