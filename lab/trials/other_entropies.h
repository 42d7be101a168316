// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/observation.h"
#include "core/types/options.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// The total entropy of [XIT] Eq. (24) over a scene's critical cells, by variances that are not
// those of the mission.
struct OtherEntropies {
  // Exact, of the field over the whole building: the same cells, linked in the same way, for every
  // robot that reads there. (In a mission's own map a critical cell that nobody has seen counts
  // with the prior of an open lattice, which is less than what one has that was seen and not
  // measured: there, to see more raises the entropy.)
  double whole_building_nats = 0.0;
  // Of loopy belief propagation, with which the paper solves ([XIT] section VI-A), over the
  // mission's map; unseen cells as in the mission.
  double propagated_nats = 0.0;
};

// `readings` are of gas, and `map` is what the robot knows of the building. Readings do not age.
// Errors: as GmrfMapper. Cost: a factorisation, and 100 sweeps over the map.
absl::StatusOr<OtherEntropies> FindOtherEntropies(const Scene& scene, const GasOptions& gas,
                                                  const std::vector<Observation>& readings,
                                                  const Grid<CellState>& map);

}  // namespace plumescout::lab
