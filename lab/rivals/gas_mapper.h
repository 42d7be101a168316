// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "core/types/cell_state.h"
#include "core/types/gas_reading.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"

namespace plumescout::lab {

// What a mapper makes of its readings, on the grid of the map that it was asked over. NaN off the
// free cells.
struct MappedGas {
  Grid<float> mean_ppm;
  Grid<float> variance_ppm2;
};

// Gas distribution mapping in its plainest form: readings in, a map out, in one go. It is what
// methods have in common, for comparing them; missions use GasMap, which keeps up with readings.
class GasMapper {
 public:
  virtual ~GasMapper() = default;

  // Takes a reading into account in every map from now on. Errors, with nothing changed: those of
  // CheckMappable.
  virtual absl::Status Add(Point2 position, const GasReading& reading) = 0;
  // The map from all readings so far.
  virtual absl::StatusOr<MappedGas> MapOver(const Grid<CellState>& states) = 0;
};

// What all mappers ask of a reading: kInvalidArgument unless it is finite, of pure gas at most, and
// its variance is not negative.
inline absl::Status CheckMappable(Point2 position, const GasReading& reading) {
  constexpr double kPure_ppm = 1e6;
  const bool fits = std::isfinite(position.x_m) && std::isfinite(position.y_m) &&
                    std::abs(reading.concentration_ppm) <= kPure_ppm &&
                    std::isfinite(reading.variance_ppm2) && reading.variance_ppm2 >= 0.0;
  if (fits) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      "a reading of ", reading.concentration_ppm, " ppm, variance ", reading.variance_ppm2,
      " ppm^2, at (", position.x_m, ", ", position.y_m, ") m cannot be mapped"));
}

}  // namespace plumescout::lab
