// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field_audit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/gas/gmrf_graph.h"
#include "core/gas/information.h"
#include "core/linalg/cholmod_solve.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// As std::max, but what is not a number counts as beyond measure.
void Raise(double& largest, double value) {
  if (!(value <= largest)) {
    largest = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  }
}

// Both computations round: by the condition number of H, 8 lambda_p / lambda_d (evidence on the
// diagonal only improves it, once that is scaled), times units of the last place. Far below the
// tolerance of 1e-5.
double RoundingShare(const GasOptions& options) {
  constexpr double kLeast = 1e-9;
  constexpr double kUnits = 100.0 * std::numeric_limits<double>::epsilon();
  return std::max(kLeast, kUnits * 8.0 * options.prior_precision_per_ppm2 /
                              options.background_precision_per_ppm2);
}

// Which square of the graph's lattice is which gas cell.
GasCell FirstGasCell(const AuditInputs& inputs) {
  return GasCellOf(inputs.corner, inputs.options.lattice_factor);
}

std::vector<Evidence> EvidenceOn(const GmrfGraph& graph, const AuditInputs& inputs) {
  std::vector<Evidence> evidence(static_cast<std::size_t>(graph.variables()));
  const GasCell first = FirstGasCell(inputs);
  for (const CellEvidence& e : inputs.evidence) {
    const GasCell square = GasCellOf(e.cell, inputs.options.lattice_factor);
    const VariableIndex variable = graph.At({square.x - first.x, square.y - first.y});
    if (variable != VariableIndex::kNone) evidence[ToSize(variable)] += e.evidence;
  }
  return evidence;
}

AuditFinding Compare(const GmrfGraph& graph, const CholmodSolution& truth,
                     const AuditInputs& inputs) {
  AuditFinding finding;
  finding.species = inputs.species;
  const GasCell first = FirstGasCell(inputs);
  double largest_mean_ppm = 0.0;
  for (std::size_t i = 0; i < truth.x.size(); ++i) {
    const Cell cell = graph.geometry().CellAtIndex(graph.cell_index(static_cast<VariableIndex>(i)));
    const GasCell gas_cell{first.x + cell.x, first.y + cell.y};
    const bool known = inputs.lattice.Contains(gas_cell);
    const std::size_t index = known ? inputs.lattice.Index(gas_cell) : 0;
    const double nothing = std::nan("");
    const double mean_ppm = known ? inputs.mean_ppm[index] : nothing;
    const double variance_ppm2 = known ? inputs.variance_ppm2[index] : nothing;
    largest_mean_ppm = std::max(largest_mean_ppm, std::abs(truth.x[i]));
    Raise(finding.mean_ppm, std::abs(mean_ppm - truth.x[i]));
    Raise(finding.variance_ratio, std::abs(variance_ppm2 / truth.inverse_diagonal[i] - 1.0));
  }
  const auto active = std::count_if(inputs.variance_ppm2.begin(), inputs.variance_ppm2.end(),
                                    [](double v) { return !std::isnan(v); });
  if (active > graph.variables()) Raise(finding.variance_ratio, std::nan(""));
  const double rounding = RoundingShare(inputs.options);
  finding.certified = finding.mean_ppm <= inputs.certified_mean_ppm + rounding * largest_mean_ppm &&
                      finding.variance_ratio <= inputs.certified_variance_ratio + rounding;
  return finding;
}

}  // namespace

absl::StatusOr<AuditFinding> RunAudit(const AuditInputs& inputs) {
  const GmrfGraph graph(inputs.states, inputs.corner, inputs.options.lattice_factor);
  const Information information =
      BuildInformation(graph, EvidenceOn(graph, inputs), inputs.options);
  PLUMESCOUT_ASSIGN_OR_RETURN(const CholmodSolution truth,
                              SolveByCholmod(information.hessian, information.negative_gradient));
  return Compare(graph, truth, inputs);
}

}  // namespace plumescout
