// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_map.h"

#include <cassert>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/gas/gmrf_graph.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// One value per variable, rounded to float; NaN off the free cells.
Grid<float> ToGrid(const GmrfGraph& graph, const std::vector<double>& values) {
  Grid<float> grid(graph.geometry(), std::numeric_limits<float>::quiet_NaN());
  for (int i = 0; i < graph.variables(); ++i) {
    grid[graph.cell_index(VariableIndex{i})] =
        static_cast<float>(values[static_cast<std::size_t>(i)]);
  }
  return grid;
}

}  // namespace

GasMap::GasMap(const GasOptions& options) : options_(options), readings_(options) {
  assert(Validate(options).ok());
}

void GasMap::Add(std::int64_t time_ns, Point2 position, const GasReading& reading) {
  readings_.Add(time_ns, position, reading);
  ++counters_.readings;
  ++counters_.waiting;
  stale_ = true;
}

absl::Status GasMap::Refresh(const Grid<CellState>& states, std::int64_t time_ns) {
  const GmrfGraph graph(states);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlacedReadings placed, readings_.PlaceAll(graph, time_ns));
  absl::StatusOr<Posterior> posterior = solver_.Solve(graph, placed.evidence, options_);
  if (!posterior.ok()) {
    return absl::InternalError(absl::StrCat("gas map: ", posterior.status().ToString()));
  }
  mean_ppm_ = ToGrid(graph, posterior->mean_ppm);
  variance_ppm2_ = ToGrid(graph, posterior->variance_ppm2);
  counters_ = placed.counters;
  stale_ = false;
  return absl::OkStatus();
}

}  // namespace plumescout
