// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/map_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout::lab {
namespace map_calibration_test {

constexpr GridGeometry kThree{0.0, 0.0, 0.1, 3, 1};

// Two critical cells with 10 ppm, and one without.
Scene Truth() {
  Scene scene;
  scene.occupancy = Grid<CellState>(kThree, CellState::kFree);
  scene.conc_mean_ppm = Grid<float>(kThree, 10.0F);
  scene.conc_mean_ppm[2] = 1.0F;
  return scene;
}

TEST(MapCalibrationTest, IsTakenOverCriticalCells) {
  Grid<float> mean_ppm(kThree, 13.0F);
  mean_ppm[1] = 9.0F;
  mean_ppm[2] = 500.0F;
  const Grid<float> variance_ppm2(kThree, 4.0F);
  const MapCalibration map = Calibrate(Truth(), mean_ppm, variance_ppm2);
  EXPECT_NEAR(map.rmse_ppm, std::sqrt((9.0 + 1.0) / 2.0), 1e-9);
  const double high = std::log(14.0 / 11.0);
  const double low = std::log(10.0 / 11.0);
  EXPECT_NEAR(map.log_rmse, std::sqrt((high * high + low * low) / 2.0), 1e-9);
  const double clean = std::log(501.0 / 2.0);
  EXPECT_NEAR(map.log_rmse_all, std::sqrt((high * high + low * low + clean * clean) / 3.0), 1e-6);
  EXPECT_NEAR(map.nlpd_nats, 0.5 * std::log(2.0 * M_PI * 4.0) + 0.5 * (9.0 + 1.0) / 4.0 / 2.0,
              1e-9);
  EXPECT_EQ(map.within_1_sigma, 0.5);
  EXPECT_EQ(map.within_2_sigma, 1.0);
  EXPECT_NEAR(map.rms_z, std::sqrt((9.0 + 1.0) / 4.0 / 2.0), 1e-9);
  EXPECT_EQ(map.estimated_cells, 2);
}

TEST(MapCalibrationTest, WhatIsNotEstimatedIsCleanAirAndHasNoSigma) {
  Grid<float> mean_ppm(kThree, 10.0F);
  mean_ppm[1] = std::numeric_limits<float>::quiet_NaN();
  const MapCalibration map = Calibrate(Truth(), mean_ppm, Grid<float>(kThree, 1.0F));
  EXPECT_NEAR(map.rmse_ppm, std::sqrt(100.0 / 2.0), 1e-9);
  EXPECT_NEAR(map.log_rmse_all, std::sqrt(std::pow(std::log(11.0 / 2.0), 2.0) / 2.0), 1e-6);
  EXPECT_EQ(map.within_1_sigma, 1.0);
  EXPECT_EQ(map.rms_z, 0.0);
  EXPECT_EQ(map.estimated_cells, 1);
}

TEST(MapCalibrationTest, AmbientAirIsPartOfTheTruthAndOfNoCriticalCell) {
  Grid<float> mean_ppm(kThree, 412.0F);
  mean_ppm[1] = std::numeric_limits<float>::quiet_NaN();
  const MapCalibration map = Calibrate(Truth(), mean_ppm, Grid<float>(kThree, 1.0F), 400.0);
  EXPECT_NEAR(map.rmse_ppm, std::sqrt((4.0 + 100.0) / 2.0), 1e-9);
  EXPECT_NEAR(map.rms_z, 2.0, 1e-9);
  EXPECT_EQ(map.estimated_cells, 1);
}

TEST(MapCalibrationTest, WithoutVarianceOrGasNothingIsPromised) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const Grid<float> mean_ppm(kThree, 13.0F);
  Scene clean = Truth();
  clean.conc_mean_ppm = Grid<float>(kThree, 0.0F);
  for (const MapCalibration& map : {Calibrate(Truth(), mean_ppm, Grid<float>(kThree, kNone)),
                                    Calibrate(Truth(), mean_ppm, Grid<float>(kThree, 0.0F)),
                                    Calibrate(clean, mean_ppm, Grid<float>(kThree, 4.0F))}) {
    EXPECT_EQ(map.estimated_cells, 0);
    for (const CalibrationFigure& figure : kSigmaFigures) {
      EXPECT_TRUE(std::isnan(map.*figure.value)) << figure.name;
    }
  }
}

TEST(MapCalibrationTest, SigmaFiguresAreTheFour) {
  ASSERT_EQ(kSigmaFigures.size(), 4u);
  EXPECT_STREQ(kSigmaFigures.front().name, "nlpd_nats");
  EXPECT_STREQ(kSigmaFigures.back().name, "rms_z");
}

}  // namespace map_calibration_test
}  // namespace plumescout::lab
