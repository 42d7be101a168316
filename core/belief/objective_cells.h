// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/belief/belief.h"
#include "core/types/grid.h"
#include "core/types/objective.h"
#include "core/types/stop.h"

namespace plumescout {

// How sure it is of each cell that what the objective says of it is so.
//
// A cell is measured once its variance by the model counts as observed (ObservedVariance_ppm2), or
// that of one within radius_m: what the prior alone says of a place decides nothing. All of
// radius_m is by ways through free cells. Of measured cells the margin is how many standard
// deviations lie between what is known and what would make the statement wrong, on the scale on
// which the field is Gaussian and with the variances that are published:
//
//   kMapAboveThreshold  from the threshold, on either side
//   kConfirmClean       from the threshold, from below
//   kFindSources        from the strongest place, as if both were independent; while no cell is
//                       surely above the threshold, from that, from below
//
// Cells that do not matter have none: of a map above the threshold those at its edge, within
// radius_m of one that is decided; of sources those within radius_m of the strongest place.
struct ObjectiveCells {
  Grid<float> margin;                    // -infinity: not measured; NaN: does not count
  float needed = 0.0F;                   // a cell is decided from this margin on
  std::optional<std::size_t> strongest;  // of kFindSources: the greatest lower bound
  bool source_found = false;             // and that is above the threshold
};

// Of the cells that are not 0 in `counted`. Of no use once `stop`, which is asked all along, says
// so. REQUIRES: the objective is not kCompleteMap; all rasters share one geometry. Cost: O(cells).
ObjectiveCells JudgeCells(const Belief& belief, const Grid<std::uint8_t>& counted,
                          const StopFn& stop = {});

// What they say of one. `kind` is that of the objective.
ObjectiveVerdict VerdictOf(const ObjectiveCells& cells, ObjectiveKind kind, std::size_t cell);

}  // namespace plumescout
