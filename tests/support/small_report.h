// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "lab/report/report_data.h"

namespace plumescout {

// A mission in a room of 20 x 10 cells of 0.5 m with one source, of which the western half is
// known: everything that a report can show is there.
inline lab::ReportData MakeSmallReport() {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const GridGeometry geometry{-1.0, 2.0, 0.5, 20, 10};
  lab::ReportData data;
  data.title = "Small room <1>";
  data.truth = Grid<CellState>(geometry, CellState::kFree);
  data.true_gas_ppm = Grid<float>(geometry);
  data.map.occupancy = Grid<CellState>(geometry);
  data.map.gas_mean_ppm = Grid<float>(geometry, kNan);
  data.map.gas_variance_ppm2 = Grid<float>(geometry, kNan);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const Cell cell = geometry.CellAtIndex(i);
    const bool wall = cell.x == 0 || cell.y == 0 || cell.x == 19 || cell.y == 9;
    const auto gas_ppm =
        static_cast<float>(100.0 * std::exp(-0.3 * std::hypot(cell.x - 5, cell.y - 5)));
    if (wall) data.truth[i] = CellState::kOccupied;
    if (!wall) (*data.true_gas_ppm)[i] = gas_ppm;
    if (cell.x >= 10) continue;
    data.map.occupancy[i] = data.truth[i];
    if (wall) continue;
    data.map.gas_mean_ppm[i] = 0.9F * gas_ppm;
    data.map.gas_variance_ppm2[i] = 0.1F + 0.02F * static_cast<float>(cell.x);
  }
  Frontier occupancy;
  for (int y = 1; y < 9; ++y) occupancy.cells.push_back({10, y});
  Frontier gas;
  gas.kind = FrontierKind::kGas;
  gas.cells = {{3, 3}, {4, 3}};
  data.map.frontiers = {occupancy, gas};
  data.driven_paths = {{{0.0, 3.0}, {1.0, 4.0}, {3.0, 4.5}}};
  Plan plan;
  plan.chosen = 0;
  plan.candidates.resize(1);
  plan.candidates[0].goal.kind = GoalKind::kGasFrontier;
  plan.candidates[0].path = {{0.0, 3.0}, {1.0, 4.0}};
  data.plans = {plan, Plan()};
  data.sources = {{1.75, 4.75}};
  data.starts = {{0.0, 3.0}};
  for (int i = 0; i <= 20; ++i) {
    const double done = i / 20.0;
    data.metrics.push_back({10.0 * i, 0.5 * done, 40.0 - 30.0 * done, 40.0, 900.0 - 500.0 * done});
  }
  data.key_numbers = {{"completeness", "50 %"}, {"RMSE", "10 ppm"}};
  return data;
}

// For it: clean but for a square in the middle of what is known, part of which nobody measured.
inline lab::ObjectiveOutcome MakeSmallOutcome(const lab::ReportData& data) {
  lab::ObjectiveOutcome outcome{
      .asked = {.kind = ObjectiveKind::kConfirmClean, .threshold_ppm = 12.5},
      .status = {.state = ObjectiveState::kRefuted,
                 .confidence = 0.98,
                 .place = Point2{1.75, 4.75}},
      .since_s = 84.4,
      .explanation = "So it is.",
      .verdicts = Grid<ObjectiveVerdict>(data.map.occupancy.geometry())};
  for (std::size_t i = 0; i < outcome.verdicts.size(); ++i) {
    const Cell cell = outcome.verdicts.geometry().CellAtIndex(i);
    if (data.map.occupancy[i] != CellState::kFree) continue;
    outcome.verdicts[i] = cell.x >= 4 && cell.x <= 6 && cell.y >= 4 && cell.y <= 6
                              ? ObjectiveVerdict::kRefuted
                              : ObjectiveVerdict::kDecided;
  }
  outcome.verdicts[Cell{1, 1}] = ObjectiveVerdict::kNotMeasured;
  outcome.verdicts[Cell{2, 1}] = ObjectiveVerdict::kUndecided;
  return outcome;
}

}  // namespace plumescout
