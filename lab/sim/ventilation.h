// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/types/rng.h"
#include "lab/formats/scene.h"
#include "lab/sim/floor_plan.h"

namespace plumescout::lab {

// Opening in the outer wall of a room, in units along the wall.
struct Window {
  Side side = Side::kWest;
  int from = 0;
  int width = 0;
  std::optional<double> inflow_mps;  // none: outlet
  std::size_t room = 0;              // index into FloorPlan::rooms
  CellRect zone;                     // inside, before it: nothing should stand here
};

// How air passes a building.
struct Ventilation {
  std::vector<Window> windows;
  // A room that air enters from outside and from no other room: no gas but its own drifts there.
  std::size_t fresh_room = 0;

  // Air that enters, through a metre of height.
  double Flow_m2_per_s() const;
};

// One or two inlets, and one to three outlets far from them and in other rooms, so that the air
// crosses the building. Nothing if the draw found no such places. REQUIRES: several rooms.
std::optional<Ventilation> DrawVentilation(const FloorPlan& plan, Rng& rng);

}  // namespace plumescout::lab
