// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/grid.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// How far a gas map is from the truth in critical cells, and whether it knows.
struct MapCalibration {
  double rmse_ppm = 0.0;
  double log_rmse = 0.0;  // of ln(1 ppm + c)
  // The same over all free cells that the map estimates, critical or not.
  double log_rmse_all = 0.0;
  // Of the cells that the map estimates, as Gaussians:
  double nlpd_nats = 0.0;       // negative logarithm of the density at the truth, mean
  double within_1_sigma = 0.0;  // share, 0.68 of true Gaussians
  double within_2_sigma = 0.0;  // 0.95
  double rms_z = 0.0;           // root mean square of error over sigma, 1
};

// Critical are free cells with a true mean above the scene's threshold; what is not estimated
// counts as 0 ppm. NaN if there are none. The map's grid may lie otherwise: a true cell is looked
// up by the position of its centre. REQUIRES: one geometry of both rasters, variances > 0 where
// finite.
MapCalibration Calibrate(const Scene& truth, const Grid<float>& mean_ppm,
                         const Grid<float>& variance_ppm2);

}  // namespace plumescout::lab
