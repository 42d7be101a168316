// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lab/sim/frame_recorder.h"
#include "lab/trials/sampling_study.h"

namespace plumescout::lab {

// A yard of 6 x 5 cells of 1 m, with a wall in it and gas in the east.
inline Scene SmallYard() {
  const GridGeometry yard{0.0, 0.0, 1.0, 6, 5};
  Scene scene;
  scene.name = "yard";
  scene.occupancy = Grid<CellState>(yard, CellState::kFree);
  scene.occupancy[Cell{3, 2}] = CellState::kOccupied;
  Grid<float> gas_ppm(yard, 0.0F);
  for (int y = 0; y < yard.height; ++y) gas_ppm[Cell{5, y}] = 8.0F;
  FrameRecorder recorder(yard, 1, 1, 1.0);
  recorder.Add({gas_ppm});
  recorder.MoveTo(scene);
  scene.sources = {{1, 5.5, 2.5, 0.5, 1.0}};
  scene.start_pose = {0.5, 0.5, 0.0};
  return scene;
}

// A sweep and random sampling, twice each, until all 29 sites are sampled.
inline SamplingPlan SmallSampling(const std::string& folder) {
  SamplingPlan plan;
  plan.worlds = {SmallYard()};
  for (const char* strategy : {"sweep", "random_sampling"}) {
    StudyRow row = MakeStudyRow(strategy, strategy, true).value();
    row.mission.occupancy.inflation_radius_m = 0.0;
    row.mission.planning.dwell_s = 2.0;
    row.mission.planning.sites.region = Rectangle{{0.0, 0.0}, {6.0, 5.0}};
    row.mission.planning.sites.survey = false;
    plan.rows.push_back(row);
  }
  plan.cases = {{"one", 0, {0.5, 0.5, 0.0}, 1}, {"two", 0, {5.5, 4.5, 0.0}, 2}};
  plan.noise = {0.0, 0.0};
  plan.folder = folder;
  return plan;
}

}  // namespace plumescout::lab
