// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/plume.h"

#include <cmath>

#include "lab/sim/ageing_depth.h"

namespace plumescout::lab {
namespace {

// Two independent draws, uniform in [-1, 1), from one of 64 bits.
struct Draws {
  explicit Draws(std::uint64_t bits)
      : east(0x1.0p-31 * static_cast<std::int32_t>(bits >> 32)),
        north(0x1.0p-31 * static_cast<std::int32_t>(bits & 0xFFFFFFFFU)) {}

  double east;
  double north;
};

}  // namespace

double FilamentContent_ppm_m3(const GasSource& source, const GasParameters& gas) {
  const double ball_m3 = std::pow(2.0 * M_PI, 1.5) * std::pow(gas.initial_sigma_m, 3.0);
  return source.rate_ppm_per_s / gas.filaments_per_s * ball_m3;
}

FilamentShape ShapeAtAge(const GasSource& source, const GasParameters& gas, double age_s) {
  const double variance_m2 = FilamentVariance_m2(gas, age_s);
  const double content = FilamentContent_ppm_m3(source, gas);
  return {content / (2.0 * M_PI * variance_m2 * DepthAtAge_m(gas, age_s)), std::sqrt(variance_m2)};
}

// Steps of the walk are uniform, not Gaussian: of many of them only the variance is left, a third
// of walk_m_^2 each, and they cost a tenth.
Plume::Plume(const LayoutRaster& raster, const MacField& wind,
             const std::vector<GasSource>& sources, const GasParameters& gas, std::uint64_t seed,
             double start_s)
    : air_(raster, wind),
      sources_(sources),
      filaments_per_s_(gas.filaments_per_s),
      walk_m_(std::sqrt(3.0 * 2.0 * gas.diffusivity_m2_per_s * kStep_s)),
      start_s_(start_s),
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
    if (air_.SpaceAt(filament.position) == GasSpace::kOutside) {
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
  const double end_s = start_s_ + static_cast<double>(steps_ + 1) * kStep_s;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const double releasing_s = ReleasingTime_s(sources_[s].release, start_s_, end_s);
    const auto due = static_cast<std::int64_t>(std::floor(filaments_per_s_ * releasing_s + 0.5));
    for (; released_[s] < due; ++released_[s]) {
      filaments_.push_back({{sources_[s].x_m, sources_[s].y_m}, 0, static_cast<std::int32_t>(s)});
    }
  }
}

Point2 Plume::Moved(Point2 from) {
  const Velocity here = air_.WindAt(from);
  const Velocity wind =
      air_.WindAt({from.x_m + 0.5 * kStep_s * here.u_mps, from.y_m + 0.5 * kStep_s * here.v_mps});
  const Draws walk(rng_.Next());
  const double east_m = wind.u_mps * kStep_s + walk_m_ * walk.east;
  const double north_m = wind.v_mps * kStep_s + walk_m_ * walk.north;
  const Point2 whole{from.x_m + east_m, from.y_m + north_m};
  if (air_.Clear(from, whole)) return whole;
  // Along the wall: the longer part first, it is the one that runs along it more often than not.
  const Point2 eastward{whole.x_m, from.y_m};
  const Point2 northward{from.x_m, whole.y_m};
  const bool east_first = std::abs(east_m) >= std::abs(north_m);
  const Point2 first = east_first ? eastward : northward;
  const Point2 second = east_first ? northward : eastward;
  if (air_.Clear(from, first)) return first;
  return air_.Clear(from, second) ? second : from;
}

}  // namespace plumescout::lab
