// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/field/cell_input.h"
#include "core/gas/gas_map.h"
#include "core/gas/information.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"

namespace plumescout::lab {

// A map, and readings of a plume in its middle, in random free cells: 300 s at 2 Hz.
struct GasCase {
  Grid<CellState> states;
  std::vector<Point2> positions;
  std::vector<double> concentrations_ppm;
};

// What a sensor without noise reads at (x, y) in a map of that size, all in cells.
double Plume_ppm(double width, double height, double x, double y);

GasCase OpenCase(int width_cells, int height_cells, std::uint64_t seed);
// Rooms, doors and boxes.
GasCase IndoorCase(int width_cells, int height_cells, std::uint64_t seed);

// The way of a mission: places the readings and computes all from scratch.
absl::StatusOr<GasMap> FreshMap(const GasCase& c);
// The same system as matrices, for other solvers.
absl::StatusOr<Information> InformationOf(const GasCase& c);
// What the readings say of each variable of `graph`, which is that of the map.
absl::StatusOr<std::vector<Evidence>> EvidenceOf(const GasCase& c, const GmrfGraph& graph);
// The same as inputs of an engine, by cell of the map.
absl::StatusOr<std::vector<CellInput>> InputsOf(const GasCase& c);

}  // namespace plumescout::lab
