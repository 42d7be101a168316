// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/belief/belief.h"
#include "core/plan/goals/goal_offer.h"
#include "core/plan/sampling/site_lattice.h"
#include "core/types/plan.h"

namespace plumescout {

// A place where the robot may be sent to sample.
struct Site {
  std::size_t index = 0;  // in the lattice
  Cell cell;
  Point2 place;                // the centre of the cell
  double travel_m = 0.0;       // exact, on the 8-connected grid
  bool sampled = false;        // a reading was taken in its square or its cell
  double mean_ppm = 0.0;       // above the background
  double variance_ppm2 = 0.0;  // of the prior on an open lattice where there is no estimate yet
};

struct Sites {
  SiteLattice lattice;
  std::vector<Site> offered;  // by index, ascending
  std::vector<RejectedGoal> rejected;
  double map_mean_ppm = 0.0;  // over the free cells of the map, above the background
};

// The sites that the robot can stand on and reach, and that are neither set aside nor stops of
// another robot's live plan: those are `rejected`. A site whose own cell is closed is left out, and
// so are those that share the cell of one before them. Cost: O(cells + sites).
Sites FindSites(const GoalQuery& query, const SiteLattice& lattice);

Goal GoalAt(const Site& site);

// Whether every one of the places is sampled, as `Site` says. Cost: O(cells + sites).
bool AreSampled(const Belief& belief, const SiteLattice& lattice,
                const std::vector<Point2>& places);

}  // namespace plumescout
