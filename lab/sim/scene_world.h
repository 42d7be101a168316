// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// What the gas does when a run outlasts the recorded frames.
enum class SeriesEnd { kHoldLastFrame, kRepeat };

struct SceneWorldOptions {
  SeriesEnd series_end = SeriesEnd::kHoldLastFrame;
  // In the air beside what the sources release, everywhere and always, [0, 1e6]: of carbon dioxide
  // some 400 ppm.
  double ambient_ppm = 0.0;
};

// kInvalidArgument naming field, value and range.
absl::Status Validate(const SceneWorldOptions& options);

// What is true around simulated robots. Immutable: any number of robots may share one.
class SceneWorld {
 public:
  // REQUIRES: the scene is valid, as ReadScene and MakeScene return it; valid options.
  explicit SceneWorld(Scene scene, const SceneWorldOptions& options = {});

  const Scene& scene() const { return scene_; }
  const Grid<CellState>& occupancy() const { return scene_.occupancy; }

  double ambient_ppm() const { return options_.ambient_ppm; }

  // Concentration at the nearest cell in the nearest frame, ppm, ambient air included. `time_s`
  // counts from frame 0.
  double Concentration_ppm(Point2 point, double time_s) const;

  // Whether a disc touches an occupied cell or reaches beyond the raster.
  bool Collides(Point2 center, double radius_m) const;

 private:
  Scene scene_;
  SceneWorldOptions options_;
};

}  // namespace plumescout::lab
