// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/plume.h"

#include <algorithm>
#include <cmath>

#include "core/grid/ray.h"

namespace plumescout::lab {
namespace {

double FilamentVariance_m2(const GasParameters& gas, double age_s) {
  return gas.initial_sigma_m * gas.initial_sigma_m + gas.growth_m2_per_s * age_s;
}

}  // namespace

double FilamentContent_ppm_m3(const GasSource& source, const GasParameters& gas) {
  const double ball_m3 = std::pow(2.0 * M_PI, 1.5) * std::pow(gas.initial_sigma_m, 3.0);
  return source.rate_ppm_per_s / gas.filaments_per_s * ball_m3;
}

FilamentShape ShapeAtAge(const GasSource& source, const GasParameters& gas, double age_s) {
  const double variance_m2 = FilamentVariance_m2(gas, age_s);
  const double vertical_m2 = variance_m2 + 2.0 * gas.diffusivity_m2_per_s * age_s;
  const double depth_m = std::min(gas.mixing_depth_m, std::sqrt(2.0 * M_PI * vertical_m2));
  const double content = FilamentContent_ppm_m3(source, gas);
  return {content / (2.0 * M_PI * variance_m2 * depth_m), std::sqrt(variance_m2)};
}

Plume::Plume(const LayoutRaster& raster, const MacField& wind,
             const std::vector<GasSource>& sources, const GasParameters& gas, std::uint64_t seed)
    : raster_(raster),
      wind_(wind),
      sources_(sources),
      filaments_per_step_(gas.filaments_per_s * kStep_s),
      walk_m_(std::sqrt(2.0 * gas.diffusivity_m2_per_s * kStep_s)),
      rng_(seed),
      released_(sources.size()),
      left_(sources.size()) {}

void Plume::Step() {
  Release();
  ++steps_;
  std::size_t kept = 0;
  for (Filament filament : filaments_) {
    filament.position = Moved(filament.position);
    ++filament.age_steps;
    if (PlaceOf(filament.position) == Place::kOutside) {
      ++left_[static_cast<std::size_t>(filament.source)];
    } else {
      filaments_[kept++] = filament;
    }
  }
  filaments_.resize(kept);
}

// The rate need not be a whole number per step: what is due by the end of this step and not yet
// out.
void Plume::Release() {
  const auto due = static_cast<std::int64_t>(
      std::floor(filaments_per_step_ * static_cast<double>(steps_ + 1) + 0.5));
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    for (; released_[s] < due; ++released_[s]) {
      filaments_.push_back({{sources_[s].x_m, sources_[s].y_m}, 0, static_cast<std::int32_t>(s)});
    }
  }
}

Point2 Plume::Moved(Point2 from) {
  const Velocity wind = wind_.At(from);
  const double east_m = wind.u_mps * kStep_s + walk_m_ * rng_.Gaussian();
  const double north_m = wind.v_mps * kStep_s + walk_m_ * rng_.Gaussian();
  return Deflected(from, east_m, north_m);
}

Point2 Plume::Deflected(Point2 from, double east_m, double north_m) const {
  const Point2 whole{from.x_m + east_m, from.y_m + north_m};
  if (Clear(from, whole)) return whole;
  // Along the wall: the longer part first, it is the one that runs along it more often than not.
  const Point2 eastward{whole.x_m, from.y_m};
  const Point2 northward{from.x_m, whole.y_m};
  const bool east_first = std::abs(east_m) >= std::abs(north_m);
  const Point2 first = east_first ? eastward : northward;
  const Point2 second = east_first ? northward : eastward;
  if (Clear(from, first)) return first;
  return Clear(from, second) ? second : from;
}

Plume::Place Plume::PlaceOf(Point2 point) const {
  const Cell cell = raster_.occupancy.geometry().CellAt(point);
  if (!raster_.occupancy.Contains(cell)) return Place::kOutside;
  if (raster_.occupancy[cell] == CellState::kFree) return Place::kInside;
  return raster_.flow.fluid[cell] != 0 ? Place::kOutside : Place::kSolid;
}

bool Plume::Clear(Point2 from, Point2 to) const {
  const GridGeometry& geometry = raster_.occupancy.geometry();
  const Cell first = geometry.CellAt(from);
  const Cell last = geometry.CellAt(to);
  const int apart = std::abs(last.x - first.x) + std::abs(last.y - first.y);
  if (apart <= 1) return PlaceOf(to) != Place::kSolid;  // the usual case: no cell in between
  return WalkSegment(geometry, from, to,
                     [this](Cell cell, double) { return raster_.flow.fluid.At(cell, 1) != 0; });
}

}  // namespace plumescout::lab
