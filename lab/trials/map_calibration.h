// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "core/types/grid.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// How far a gas map is from the truth in critical cells, and whether it knows.
struct MapCalibration {
  double rmse_ppm = 0.0;
  double log_rmse = 0.0;  // of ln(1 ppm + c)
  // The same over all free cells that the map estimates, critical or not.
  double log_rmse_all = 0.0;
  // Of the critical cells that the map estimates with a variance, as Gaussians; NaN without:
  double nlpd_nats = 0.0;       // negative logarithm of the density at the truth, mean
  double within_1_sigma = 0.0;  // share, 0.68 of true Gaussians
  double within_2_sigma = 0.0;  // 0.95
  double rms_z = 0.0;           // root mean square of error over sigma, 1
  int estimated_cells = 0;

  friend bool operator==(const MapCalibration&, const MapCalibration&) = default;
};

// As tables, summaries and files name them.
struct CalibrationFigure {
  const char* name;
  double MapCalibration::*value;
};
inline constexpr std::array<CalibrationFigure, 7> kCalibrationFigures = {{
    {"rmse_ppm", &MapCalibration::rmse_ppm},
    {"log_rmse", &MapCalibration::log_rmse},
    {"log_rmse_all", &MapCalibration::log_rmse_all},
    {"nlpd_nats", &MapCalibration::nlpd_nats},
    {"within_1_sigma", &MapCalibration::within_1_sigma},
    {"within_2_sigma", &MapCalibration::within_2_sigma},
    {"rms_z", &MapCalibration::rms_z},
}};
// Of those, what tells whether a map knows how far off it is.
inline constexpr std::span kSigmaFigures = std::span(kCalibrationFigures).subspan<3>();

// Critical are free cells with a true mean of the scene's gas above the scene's threshold; the
// truth is that and `ambient_ppm`, and what is not estimated counts as clean air. NaN if there are
// none. The map's grid may lie otherwise: a true cell is looked up by the position of its centre.
// REQUIRES: one geometry of both rasters.
MapCalibration Calibrate(const Scene& truth, const Grid<float>& mean_ppm,
                         const Grid<float>& variance_ppm2, double ambient_ppm = 0.0);

}  // namespace plumescout::lab
