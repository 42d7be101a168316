// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"
#include "formats/scene.h"

namespace plumescout::lab {

// What the gas does when a run outlasts the recorded frames.
enum class SeriesEnd { kHoldLastFrame, kRepeat };

// What is true around simulated robots. Immutable: any number of robots may share one.
class SceneWorld {
 public:
  // REQUIRES: the scene is valid, as ReadScene and MakeScene return it.
  explicit SceneWorld(Scene scene, SeriesEnd series_end = SeriesEnd::kHoldLastFrame);

  const Scene& scene() const { return scene_; }
  const Grid<CellState>& occupancy() const { return scene_.occupancy; }

  // Concentration at the nearest cell in the nearest frame, ppm. `time_s` counts from frame 0.
  double Concentration_ppm(Point2 point, double time_s) const;

  // Whether a disc touches an occupied cell or reaches beyond the raster.
  bool Collides(Point2 center, double radius_m) const;

 private:
  Scene scene_;
  SeriesEnd series_end_;
};

}  // namespace plumescout::lab
