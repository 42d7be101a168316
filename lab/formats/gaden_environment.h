// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace plumescout::lab {

// What GADEN (github.com/MAPIRlab/gaden_core) calls the state of a cell of its environment.
enum class GadenCell : std::uint8_t { kFree = 0, kObstacle = 1, kOutlet = 2 };

// GADEN's building: cubes in a box, in metres.
struct GadenEnvironment {
  std::array<int, 3> cells{};   // along x, y, z
  std::array<double, 3> min{};  // corner of the box
  double cell_size_m = 0.0;
  std::vector<GadenCell> states;  // x runs fastest, then y

  std::size_t size() const {
    return static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) *
           static_cast<std::size_t>(cells[2]);
  }
  // REQUIRES: inside.
  std::size_t Index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(cells[0]) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(z));
  }
  // Whether the cell that holds the point is free; not if the point lies outside.
  bool IsFree(double x_m, double y_m, double z_m) const;
};

// Reads OccupancyGrid3D.csv. Four header lines, "#env_min(m) x y z", "#env_max(m) x y z",
// "#num_cells x y z" and "#cell_size(m) s"; then for each z a line for each x with the states of
// all y, closed by a line ";".
//
// Errors, naming file, line and value: those of ReadFile; kDataLoss if the file ends early or has
// lines left over; kInvalidArgument for anything else than such numbers or more than 10^8 cells.
absl::StatusOr<GadenEnvironment> ReadGadenEnvironment(const std::string& path);

}  // namespace plumescout::lab
