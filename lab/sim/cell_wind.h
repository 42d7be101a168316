// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "lab/formats/scene.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

// Wind at the centres of free cells, from the faces of each; 0 in others. REQUIRES: all of one
// geometry.
WindField CellWind(const MacField& wind, const Grid<CellState>& occupancy);

// Wind on the faces from one that is known at the cells' centres only, as of a scene made
// elsewhere: means of neighbours between free cells, 0 on all other faces. REQUIRES: all of one
// geometry.
MacField FaceWind(const WindField& wind, const Grid<CellState>& occupancy);

// The nearest wind that flows into no free cell more than out of it (to a millionth): `wind` less a
// gradient, through the same faces. A horizontal slice of a flow in space has divergence of its
// own; the air that comes from above and goes there is lost with it. Errors: those of
// SparseCholesky. Cost: one factorisation. REQUIRES: no wind but between free cells; all of one
// geometry, finite.
absl::StatusOr<MacField> WithoutDivergence(MacField wind, const Grid<CellState>& occupancy);

}  // namespace plumescout::lab
