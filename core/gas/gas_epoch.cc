// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_epoch.h"

#include "core/gas/gmrf_graph.h"

namespace plumescout {

void GasEpoch::Recompute() {
  if (done_) return;
  const GmrfGraph graph(inputs_.states);
  const auto placed = inputs_.readings.PlaceAll(graph, inputs_.time_ns);
  if (placed.ok()) {
    PosteriorSolver solver;
    posterior_ = solver.Solve(graph, placed->evidence, inputs_.options);
  } else {
    posterior_ = placed.status();
  }
  done_ = true;
}

}  // namespace plumescout
