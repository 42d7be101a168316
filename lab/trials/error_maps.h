// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lab/formats/scene.h"
#include "lab/report/map_panel.h"
#include "lab/trials/trial.h"

namespace plumescout::lab {

// Where in a building gas maps are wrong.

// Critical cells, free and above the scene's threshold, by how much gas they hold.
enum class GasPart {
  kMost,  // the twentieth with the most gas
  kRest,
};

// RMSE over the part's cells of the `map`-th map that each trial kept, ppm. What is not estimated
// counts as 0 ppm. REQUIRES: every trial kept such a map, on the scene's grid. Cost: O(trials *
// cells).
std::vector<double> PartErrors_ppm(const Scene& scene, const std::vector<TrialRecord>& trials,
                                   std::size_t map, GasPart part);

// Share of the part in the sum of the squared concentrations of all critical cells: its share in
// the error of a map without any gas. 0 without critical cells.
double ShareOfSquares(const Scene& scene, GasPart part);

// [XIT] Fig. 9: root of the mean squared error over trials by cell, critical cells outlined.
// REQUIRES: as PartErrors_ppm, and at least one trial.
MapPanel MakeErrorPanel(const Scene& scene, const std::vector<TrialRecord>& trials, std::size_t map,
                        const std::string& title);

}  // namespace plumescout::lab
