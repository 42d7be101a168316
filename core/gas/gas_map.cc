// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_map.h"

#include <cassert>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

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

absl::Status PlaceAnew(const Grid<CellState>& states, ReadingStore& readings) {
  std::vector<std::size_t> all(states.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return readings.Place(states, all);
}

absl::StatusOr<std::vector<Evidence>> EvidenceByVariable(const GmrfGraph& graph,
                                                         const ReadingStore& readings,
                                                         std::int64_t time_ns) {
  std::vector<Evidence> evidence(static_cast<std::size_t>(graph.variables()));
  if (graph.variables() == 0) return evidence;
  PLUMESCOUT_ASSIGN_OR_RETURN(const AnchorCell corner,
                              CornerOf(graph.geometry(), readings.anchor()));
  for (const CellEvidence& c : readings.EvidenceAsOf(time_ns)) {
    evidence[ToSize(graph.At({c.cell.x - corner.x, c.cell.y - corner.y}))] = c.evidence;
  }
  return evidence;
}

}  // namespace

GasMap::GasMap(const GasOptions& options) : options_(options), readings_(options) {
  assert(Validate(options).ok());
}

void GasMap::Add(std::int64_t time_ns, Point2 position, const GasReading& reading) {
  readings_.Add(time_ns, position, reading);
  stale_ = true;
}

absl::Status GasMap::Refresh(const Grid<CellState>& states, std::int64_t time_ns) {
  const GmrfGraph graph(states);
  PLUMESCOUT_RETURN_IF_ERROR(PlaceAnew(states, readings_));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Evidence> evidence,
                              EvidenceByVariable(graph, readings_, time_ns));
  absl::StatusOr<Posterior> posterior = solver_.Solve(graph, evidence, options_);
  if (!posterior.ok()) {
    return absl::InternalError(absl::StrCat("gas map: ", posterior.status().ToString()));
  }
  mean_ppm_ = ToGrid(graph, posterior->mean_ppm);
  variance_ppm2_ = ToGrid(graph, posterior->variance_ppm2);
  stale_ = false;
  return absl::OkStatus();
}

}  // namespace plumescout
