// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/other_entropies.h"

#include <cmath>
#include <cstdint>
#include <variant>

#include "core/gas/gmrf_graph.h"
#include "core/gas/information.h"
#include "core/types/status_macros.h"
#include "lab/rivals/belief_propagation.h"
#include "lab/rivals/posterior.h"

namespace plumescout::lab {
namespace {

std::vector<Evidence> EvidenceOf(const GmrfGraph& graph, const GasOptions& gas,
                                 const std::vector<Observation>& readings) {
  std::vector<Evidence> evidence(static_cast<std::size_t>(graph.variables()));
  for (const Observation& observation : readings) {
    const auto& reading = std::get<GasReading>(observation.payload);
    const Cell cell = graph.geometry().CellAt(observation.pose.position());
    const VariableIndex variable = graph.At(cell);
    if (variable == VariableIndex::kNone) continue;
    const double precision = reading.variance_ppm2 > 0.0 ? 1.0 / reading.variance_ppm2
                                                         : gas.observation_precision_per_ppm2;
    evidence[ToSize(variable)] +=
        {precision, precision * (reading.concentration_ppm - gas.background_mean_ppm)};
  }
  return evidence;
}

// Over critical cells; one that is no variable has the prior's variance.
double Entropy_nats(const Scene& scene, const GmrfGraph& graph, const Posterior& posterior,
                    double prior_variance_ppm2) {
  double nats = 0.0;
  for (std::size_t i = 0; i < scene.conc_mean_ppm.size(); ++i) {
    const bool critical = scene.occupancy[i] == CellState::kFree &&
                          scene.conc_mean_ppm[i] > scene.critical_threshold_ppm;
    if (!critical) continue;
    const Point2 center = scene.geometry().Center(scene.geometry().CellAtIndex(i));
    const VariableIndex variable = graph.At(graph.geometry().CellAt(center));
    const double variance_ppm2 = variable == VariableIndex::kNone
                                     ? prior_variance_ppm2
                                     : posterior.variance_ppm2[ToSize(variable)];
    nats += 0.5 * std::log(2.0 * M_PI * M_E * variance_ppm2);
  }
  return nats;
}

Posterior Propagated(const GmrfGraph& graph, const GasOptions& gas,
                     const std::vector<Evidence>& evidence) {
  constexpr std::int64_t kSendsPerCell = 100;  // variances have settled by then
  BeliefPropagation propagation(graph, gas, {});
  for (int i = 0; i < graph.variables(); ++i) {
    const auto variable = static_cast<VariableIndex>(i);
    propagation.SetEvidence(variable, evidence[ToSize(variable)]);
  }
  propagation.Propagate(kSendsPerCell * graph.variables());
  return propagation.Beliefs();
}

}  // namespace

absl::StatusOr<OtherEntropies> FindOtherEntropies(const Scene& scene, const GasOptions& gas,
                                                  const std::vector<Observation>& readings,
                                                  const Grid<CellState>& map) {
  const double prior_ppm2 = OpenLatticeVariance_ppm2(gas);
  OtherEntropies entropies;
  const GmrfGraph building(scene.occupancy);
  PosteriorSolver solver;
  PLUMESCOUT_ASSIGN_OR_RETURN(const Posterior exact,
                              solver.Solve(building, EvidenceOf(building, gas, readings), gas));
  entropies.whole_building_nats = Entropy_nats(scene, building, exact, prior_ppm2);
  const GmrfGraph seen(map);
  const Posterior propagated = Propagated(seen, gas, EvidenceOf(seen, gas, readings));
  entropies.propagated_nats = Entropy_nats(scene, seen, propagated, prior_ppm2);
  return entropies;
}

}  // namespace plumescout::lab
