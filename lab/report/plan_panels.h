// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "lab/report/map_panel.h"

namespace plumescout::lab {

// One planning step. Rasters of one geometry.
struct PlanPicture {
  std::string title;
  Grid<CellState> occupancy;
  Grid<float> information;                  // I-hat, [0, 1]; NaN where nobody may drive
  std::vector<std::array<Point2, 2>> tree;  // edges; may be empty
  Pose2 robot;
  Plan plan;
};

// Rejected goals that have a letter and a row of the table; the others are crosses.
inline constexpr std::size_t kListedRejections = 8;

// "1", "2", ... for candidates; "a", "b", ... for rejected goals, empty from kListedRejections on.
std::string CandidateLabel(std::size_t index);
std::string RejectionLabel(std::size_t index);

Rgb GoalColor(GoalKind kind);
inline constexpr Rgb kChosenPathColor{206, 30, 140};

// The information map with the search tree on it, and the map with the candidates' paths, the
// chosen one thick, and all goals, labelled as in the tables.
std::vector<MapPanel> MakePlanPanels(const PlanPicture& picture);

}  // namespace plumescout::lab
