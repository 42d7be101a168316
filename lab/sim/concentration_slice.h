// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "lab/sim/line_of_sight.h"
#include "lab/sim/plume.h"

namespace plumescout::lab {

// Turns filaments into concentration at the cells' centres: the sum of their Gaussians, each cut
// off at 3 sigma and where the filament's cell has no line of sight (GADEN's rule, between cell
// centres here; gas behind a wall is left out, not reflected). Radii are also capped at
// LineOfSight::kMaxRadius_cells. Cost: the cells within 3 sigma, per filament.
class SliceRenderer {
 public:
  // `occupancy` must outlive the renderer.
  SliceRenderer(const Grid<CellState>& occupancy, const std::vector<GasSource>& sources,
                const GasParameters& gas);

  // One layer per source, ppm; 0 on occupied cells.
  std::vector<Grid<float>> Render(const std::vector<Filament>& filaments);

 private:
  // Filaments of one age, in units of cells, released at 1 ppm/s.
  struct AgeShape {
    double peak_ppm = 0.0;
    double exponent = 0.0;  // of the Gaussian exp(exponent * r^2)
    double edge = 0.0;      // exp(exponent)
    double cut_off = 0.0;
    int reach = 0;  // no cell farther than this, per axis, is within the cut-off
  };

  const AgeShape& ShapeOf(int age_steps);
  void Add(const Filament& filament, float* layer);

  const Grid<CellState>& occupancy_;
  std::vector<GasSource> sources_;
  GasParameters gas_;
  LineOfSight sight_;
  std::vector<AgeShape> shapes_;            // by age in steps
  std::vector<std::vector<float>> padded_;  // layers being drawn
};

}  // namespace plumescout::lab
