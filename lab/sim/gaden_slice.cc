// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/gaden_slice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lab/formats/gaden_wind.h"

namespace plumescout::lab {
namespace {

using Point3 = std::array<double, 3>;

double Distance_m(const Point3& a, const Point3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

bool Sees(const GadenEnvironment& environment, const Point3& from, const Point3& to) {
  if (!environment.IsFree(from[0], from[1], from[2])) return false;
  if (!environment.IsFree(to[0], to[1], to[2])) return false;
  const int steps = static_cast<int>(Distance_m(from, to) / environment.cell_size_m);
  for (int i = 1; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    if (!environment.IsFree(from[0] + share * (to[0] - from[0]),
                            from[1] + share * (to[1] - from[1]),
                            from[2] + share * (to[2] - from[2]))) {
      return false;
    }
  }
  return true;
}

// Adds one filament to the cells of the slice that it reaches.
void AddFilament(const GadenEnvironment& environment, const GadenFilament& filament,
                 double peak_ppm, double height_m, Grid<double>& slice) {
  constexpr double kCutOff_sigmas = 3.0;
  constexpr double kCentimetersPerM = 100.0;
  const GridGeometry& geometry = slice.geometry();
  const double sigma_m = filament.sigma_cm / kCentimetersPerM;
  const double reach_m = kCutOff_sigmas * sigma_m;
  const Point3& at = filament.position_m;
  if (std::abs(at[2] - height_m) >= reach_m) return;
  const Cell low = geometry.CellAt({at[0] - reach_m, at[1] - reach_m});
  const Cell high = geometry.CellAt({at[0] + reach_m, at[1] + reach_m});
  for (int y = std::max(low.y, 0); y <= std::min(high.y, geometry.height - 1); ++y) {
    for (int x = std::max(low.x, 0); x <= std::min(high.x, geometry.width - 1); ++x) {
      const Point2 center = geometry.Center({x, y});
      const Point3 point = {center.x_m, center.y_m, height_m};
      const double distance_m = Distance_m(point, at);
      if (distance_m >= reach_m || !Sees(environment, point, at)) continue;
      const double sigmas = distance_m / sigma_m;
      slice[Cell{x, y}] += peak_ppm * std::exp(-sigmas * sigmas / 2.0);
    }
  }
}

}  // namespace

int LayerAt(const GadenEnvironment& environment, double height_m) {
  return static_cast<int>((height_m - environment.min[2]) / environment.cell_size_m);
}

Grid<float> SliceGadenFrame(const GadenEnvironment& environment, const GadenFrame& frame,
                            double height_m) {
  const GridGeometry geometry = SliceGeometry(environment);
  const int z = LayerAt(environment, height_m);
  Grid<double> sum(geometry);
  for (const GadenFilament& filament : frame.filaments) {
    AddFilament(environment, filament, frame.PeakPpm(filament), height_m, sum);
  }
  Grid<float> slice(geometry);
  for (std::size_t i = 0; i < slice.size(); ++i) {
    const Cell cell = geometry.CellAtIndex(i);
    const std::size_t voxel = environment.Index(cell.x, cell.y, z);
    if (environment.states[voxel] != GadenCell::kFree) continue;
    slice[i] = frame.concentrations_ppm.empty() ? static_cast<float>(sum[i])
                                                : frame.concentrations_ppm[voxel];
  }
  return slice;
}

}  // namespace plumescout::lab
