// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/pose2.h"
#include "core/types/rng.h"
#include "lab/sim/air.h"
#include "lab/sim/layout.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

// A puff of gas: round Gaussian that the wind carries as a whole (Farrell et al. 2002).
struct Filament {
  Point2 position;
  std::int32_t age_steps = 0;
  std::int32_t source = 0;  // index into the sources

  friend bool operator==(const Filament&, const Filament&) = default;
};

// The cloud of one filament at the sensor's height: peak * exp(-r^2 / (2 sigma^2)).
struct FilamentShape {
  double peak_ppm = 0.0;
  double sigma_m = 0.0;
};

// Gas in one filament, ppm m^3: a fresh filament is a ball with `rate / filaments_per_s` ppm in its
// centre, so a source of rate r releases r (2 pi)^(3/2) sigma_0^3 ppm m^3/s.
double FilamentContent_ppm_m3(const GasSource& source, const GasParameters& gas);

// With peak = content / (2 pi sigma^2 depth), widths and depths as in ageing_depth.h, gas is
// conserved at every age.
FilamentShape ShapeAtAge(const GasSource& source, const GasParameters& gas, double age_s);

// Filaments in a steady wind. Each fixed step releases new ones at every source whose schedule says
// so, carries all along the wind (midpoint rule: Euler's would fling gas out of eddies) and lets
// them walk at random with diffusivity K. A move through a solid keeps the part along the wall, or
// else does not take place: along walls the walk goes as easily back as forth, so well-mixed gas
// stays well mixed. Filaments that reach an opening have left for good. Deterministic in its
// arguments. Cost of a step: some 60 ns per filament.
class Plume {
 public:
  static constexpr double kStep_s = 0.05;  // air at 6 m/s crosses 3 cells of 0.1 m

  // Begins at `start_s` on the clock of the sources' schedules, without gas.
  // REQUIRES: all of one layout, which is valid; `wind` is finite.
  Plume(const LayoutRaster& raster, const MacField& wind, const std::vector<GasSource>& sources,
        const GasParameters& gas, std::uint64_t seed, double start_s = 0.0);

  void Step();

  double time_s() const { return start_s_ + static_cast<double>(steps_) * kStep_s; }
  const std::vector<Filament>& filaments() const { return filaments_; }  // oldest first
  // By source, in filaments: released() = inside + left().
  const std::vector<std::int64_t>& released() const { return released_; }
  const std::vector<std::int64_t>& left() const { return left_; }

 private:
  void Release();
  Point2 Moved(Point2 from);

  Air air_;
  std::vector<GasSource> sources_;
  double filaments_per_s_;
  double walk_m_;  // the random walk goes at most so far in one step and direction
  double start_s_;
  Rng rng_;
  std::int64_t steps_ = 0;
  std::vector<Filament> filaments_;
  std::vector<std::int64_t> released_;
  std::vector<std::int64_t> left_;
};

}  // namespace plumescout::lab
