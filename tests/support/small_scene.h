// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lab/formats/scene.h"

namespace plumescout::lab {

// A valid scene of 5 x 4 cells with a wall around it, two sources, three frames, wind and two
// openings.
inline Scene MakeSmallScene() {
  const GridGeometry geometry{-0.25, 1.0, 0.1, 5, 4};
  Scene scene;
  scene.name = "small";
  scene.sensor_height_m = 0.45;
  scene.occupancy = Grid<CellState>(geometry, CellState::kOccupied);
  scene.conc_mean_ppm = Grid<float>(geometry);
  scene.conc_std_ppm = Grid<float>(geometry);
  scene.conc_mean_by_source_ppm.assign(2, Grid<float>(geometry));
  scene.wind = WindField{Grid<float>(geometry), Grid<float>(geometry)};
  for (int y = 1; y < geometry.height - 1; ++y) {
    for (int x = 1; x < geometry.width - 1; ++x) {
      const Cell cell{x, y};
      scene.occupancy[cell] = CellState::kFree;
      scene.conc_mean_by_source_ppm[0][cell] = static_cast<float>(x);
      scene.conc_mean_by_source_ppm[1][cell] = 0.1F * static_cast<float>(y);
      scene.conc_mean_ppm[cell] = static_cast<float>(x) + 0.1F * static_cast<float>(y);
      scene.conc_std_ppm[cell] = 0.25F;
      scene.wind->u_mps[cell] = -0.5F;
      scene.wind->v_mps[cell] = 0.125F * static_cast<float>(x);
    }
  }
  scene.series.frames = 3;
  for (std::uint16_t i = 0; i < 3 * 20; ++i) scene.series.counts.push_back(i);
  scene.sources = {{0, 0.0, 1.2, 0.5, 600.0}, {7, 0.1, 1.15, 0.25, 1000.0}};
  scene.start_pose = {0.0, 1.15, 3.1};
  scene.openings = {{Side::kWest, 1.1, 1.2, 0.5}, {Side::kEast, 1.1, 1.3, {}}};
  return scene;
}

}  // namespace plumescout::lab
