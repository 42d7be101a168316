// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/gmrf_mapper.h"

#include <limits>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout::lab {

absl::Status GmrfMapper::Add(Point2 position, const GasReading& reading) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckMappable(position, reading));
  const double precision = reading.variance_ppm2 > 0.0 ? 1.0 / reading.variance_ppm2
                                                       : options_.observation_precision_per_ppm2;
  const double deviation_ppm = reading.concentration_ppm - options_.background_mean_ppm;
  readings_.push_back({position, {precision, precision * deviation_ppm}});
  return absl::OkStatus();
}

absl::StatusOr<MappedGas> GmrfMapper::MapOver(const Grid<CellState>& states) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  MappedGas gas{Grid<float>(states.geometry(), kNone), Grid<float>(states.geometry(), kNone)};
  const GmrfGraph graph(states);
  if (graph.variables() == 0) return gas;
  std::vector<Evidence> evidence(static_cast<std::size_t>(graph.variables()));
  for (const Reading& reading : readings_) {
    const VariableIndex variable = graph.At(states.geometry().CellAt(reading.position));
    if (variable != VariableIndex::kNone) evidence[ToSize(variable)] += reading.evidence;
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const Posterior posterior, solver_.Solve(graph, evidence, options_));
  for (int i = 0; i < graph.variables(); ++i) {
    const std::size_t cell = graph.cell_index(VariableIndex{i});
    const auto k = static_cast<std::size_t>(i);
    gas.mean_ppm[cell] = static_cast<float>(posterior.mean_ppm[k]);
    gas.variance_ppm2[cell] = static_cast<float>(posterior.variance_ppm2[k]);
  }
  return gas;
}

}  // namespace plumescout::lab
