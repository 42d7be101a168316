// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/rng.h"
#include "lab/sim/floor_plan.h"

namespace plumescout::lab {

// Between solids that do not touch: 0.8 m, so that a robot kept 0.2 m off all of them passes.
inline constexpr int kPassage_units = 4;

// Furnishes the rooms: shelves along walls and tables in rooms; containers, rows of shelves or
// pillars in halls; a cupboard here and there in corridors. Pieces touch a wall or leave a passage
// to it, leave a passage between each other, and stay out of the `clear` rectangles.
std::vector<CellRect> DrawFurniture(const FloorPlan& plan, const std::vector<CellRect>& clear,
                                    Rng& rng);

}  // namespace plumescout::lab
