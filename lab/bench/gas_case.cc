// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/gas_case.h"

#include <cmath>
#include <utility>

#include "core/gas/gmrf_graph.h"
#include "core/gas/reading_store.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr int kReadings = 600;

GasCase WithReadings(Grid<CellState> states, std::uint64_t seed) {
  constexpr double kNoise_ppm = 0.5;
  Rng rng(seed);
  GasCase c{std::move(states), {}, {}};
  const GridGeometry& geometry = c.states.geometry();
  while (c.positions.size() < kReadings) {
    const Cell cell = geometry.CellAtIndex(rng.Below(c.states.size()));
    if (c.states[cell] != CellState::kFree) continue;
    c.positions.push_back(geometry.Center(cell));
    c.concentrations_ppm.push_back(Plume_ppm(geometry.width, geometry.height, cell.x, cell.y) +
                                   kNoise_ppm * rng.Gaussian());
  }
  return c;
}

}  // namespace

double Plume_ppm(double width, double height, double x, double y) {
  constexpr double kPeak_ppm = 50.0;
  constexpr double kWidths = 4.0;  // of the plume in that of the map
  const double distance = std::hypot(x - width / 2.0, y - height / 2.0) / (width / kWidths);
  return kPeak_ppm * std::exp(-distance * distance);
}

GasCase OpenCase(int width_cells, int height_cells, std::uint64_t seed) {
  const GridGeometry geometry{0.0, 0.0, 0.1, width_cells, height_cells};
  return WithReadings(Grid<CellState>(geometry, CellState::kFree), seed);
}

GasCase IndoorCase(int width_cells, int height_cells, std::uint64_t seed) {
  const Grid<std::uint8_t> walls = MakeBuilding(width_cells, height_cells, seed);
  Grid<CellState> states(walls.geometry());
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i] = walls[i] != 0 ? CellState::kOccupied : CellState::kFree;
  }
  return WithReadings(std::move(states), seed);
}

absl::StatusOr<GasMap> FreshMap(const GasCase& c) {
  GasMap map{GasOptions()};
  for (std::size_t k = 0; k < c.positions.size(); ++k) {
    map.Add(0, c.positions[k], {c.concentrations_ppm[k]});
  }
  PLUMESCOUT_RETURN_IF_ERROR(map.Refresh(c.states, 0));
  return map;
}

absl::StatusOr<std::vector<Evidence>> EvidenceOf(const GasCase& c, const GmrfGraph& graph) {
  ReadingStore store{GasOptions()};
  for (std::size_t k = 0; k < c.positions.size(); ++k) {
    store.Add(0, c.positions[k], {c.concentrations_ppm[k]});
  }
  PLUMESCOUT_RETURN_IF_ERROR(store.Place(c.states, {}));
  std::vector<Evidence> evidence(static_cast<std::size_t>(graph.variables()));
  for (const AnchorCell cell : store.TakeChanged()) {
    evidence[ToSize(graph.At({cell.x, cell.y}))] = store.EvidenceAt(cell);
  }
  return evidence;
}

absl::StatusOr<Information> InformationOf(const GasCase& c) {
  const GmrfGraph graph(c.states);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Evidence> evidence, EvidenceOf(c, graph));
  return BuildInformation(graph, evidence, GasOptions());
}

absl::StatusOr<std::vector<CellInput>> InputsOf(const GasCase& c) {
  const GmrfGraph graph(c.states);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Evidence> evidence, EvidenceOf(c, graph));
  std::vector<CellInput> inputs(c.states.size());
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    CellInput& input = inputs[graph.cell_index(VariableIndex{static_cast<int>(i)})];
    input.active = true;
    input.precision = evidence[i].precision;
    input.weighted_deviation = evidence[i].weighted_deviation;
  }
  return inputs;
}

}  // namespace plumescout::lab
