// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/types/grid.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// Collects the frames of a scene: the series, and sums for the means.
class FrameRecorder {
 public:
  // `frames` is how many will be added, for the memory they take.
  FrameRecorder(const GridGeometry& geometry, std::size_t sources, int frames,
                double frame_period_s);

  // One layer per source, ppm. REQUIRES: finite and not negative.
  void Add(const std::vector<Grid<float>>& layers);

  // Fills the series and the concentrations of `scene`. REQUIRES: at least one frame.
  void MoveTo(Scene& scene);

 private:
  GridGeometry geometry_;
  ConcentrationSeries series_;
  std::vector<std::vector<double>> sums_;  // by source and cell
  std::vector<double> squares_;            // of the sum of all sources, by cell
};

}  // namespace plumescout::lab
