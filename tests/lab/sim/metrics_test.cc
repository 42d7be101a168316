// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/grid_art.h"

namespace plumescout::lab {
namespace metrics_test {

constexpr double kPriorVariance_ppm2 = 0.3;
constexpr double kRounding = 1e-9;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Eq. (24) for one cell.
double Entropy(double variance_ppm2) {
  return 0.5 * std::log(2.0 * M_PI * std::exp(1.0) * variance_ppm2);
}

// Five free cells around the start S and one that is cut off; critical are A (10 ppm) and B (4
// ppm); C is right at the threshold of 2.5 ppm.
const testing::GridArt kArt = {
    "#######",  //
    "#ASB#.#",  //
    "#C..#.#",  //
    "#######",
};

Scene MakeScene() {
  Scene scene;
  scene.occupancy = testing::GridFromArt(kArt);
  scene.conc_mean_ppm = Grid<float>(scene.geometry());
  scene.conc_mean_ppm[testing::CellInArt(kArt, 'A')] = 10.0F;
  scene.conc_mean_ppm[testing::CellInArt(kArt, 'B')] = 4.0F;
  scene.conc_mean_ppm[testing::CellInArt(kArt, 'C')] = 2.5F;
  const Point2 start = scene.geometry().Center(testing::CellInArt(kArt, 'S'));
  scene.start_pose = {start.x_m, start.y_m, 0.0};
  return scene;
}

// Nothing known, on a grid of the given geometry.
MapSnapshot BlankMap(const GridGeometry& geometry) {
  MapSnapshot map;
  map.occupancy = Grid<CellState>(geometry, CellState::kUnknown);
  map.gas_mean_ppm = Grid<float>(geometry, kNan);
  map.gas_variance_ppm2 = Grid<float>(geometry, kNan);
  return map;
}

MapMetrics Evaluate(const Scene& scene, const MapSnapshot& map) {
  return MapEvaluator(scene, kPriorVariance_ppm2).Evaluate(map);
}

TEST(MetricsTest, GivesABlankMapTheZeroErrorAndThePriorsEntropy) {
  const Scene scene = MakeScene();
  const MapMetrics metrics = Evaluate(scene, BlankMap(scene.geometry()));
  EXPECT_EQ(metrics.critical_cells, 2);
  EXPECT_EQ(metrics.completeness, 0.0);
  EXPECT_NEAR(metrics.rmse_ppm, std::sqrt((10.0 * 10.0 + 4.0 * 4.0) / 2.0), kRounding);
  EXPECT_EQ(metrics.rmse_zero_ppm, metrics.rmse_ppm);
  EXPECT_NEAR(metrics.entropy_nats, 2.0 * Entropy(0.3), kRounding);
}

TEST(MetricsTest, TakesAMapWithoutAnyCells) {
  const MapMetrics metrics = Evaluate(MakeScene(), MapSnapshot{});
  EXPECT_EQ(metrics.completeness, 0.0);
  EXPECT_EQ(metrics.rmse_ppm, metrics.rmse_zero_ppm);
}

TEST(MetricsTest, JudgesEstimatesWhereThereAreAny) {
  const Scene scene = MakeScene();
  MapSnapshot map = BlankMap(scene.geometry());
  map.gas_mean_ppm[testing::CellInArt(kArt, 'A')] = 7.0F;
  map.gas_variance_ppm2[testing::CellInArt(kArt, 'A')] = 0.125F;
  map.gas_mean_ppm[testing::CellInArt(kArt, 'C')] = 99.0F;  // not critical: no matter
  map.gas_variance_ppm2[testing::CellInArt(kArt, 'C')] = 9.0F;
  const MapMetrics metrics = Evaluate(scene, map);
  EXPECT_NEAR(metrics.rmse_ppm, std::sqrt((3.0 * 3.0 + 4.0 * 4.0) / 2.0), kRounding);
  EXPECT_NEAR(metrics.rmse_zero_ppm, std::sqrt(58.0), kRounding);
  EXPECT_NEAR(metrics.entropy_nats, Entropy(0.125) + Entropy(0.3), kRounding);
}

TEST(MetricsTest, CountsKnownFreeCellsOfTheStartsSpaceOnly) {
  const Scene scene = MakeScene();
  MapSnapshot map = BlankMap(scene.geometry());
  map.occupancy[testing::CellInArt(kArt, 'A')] = CellState::kFree;
  map.occupancy[testing::CellInArt(kArt, 'S')] = CellState::kFree;
  map.occupancy[testing::CellInArt(kArt, 'B')] = CellState::kOccupied;  // wrongly
  map.occupancy[Cell(5, 1)] = CellState::kFree;                         // cut off
  map.occupancy[Cell(0, 0)] = CellState::kFree;                         // truly a wall
  EXPECT_NEAR(Evaluate(scene, map).completeness, 2.0 / 6.0, kRounding);
}

TEST(MetricsTest, FindsCellsByPositionOnAnotherGrid) {
  const Scene scene = MakeScene();
  GridGeometry shifted = scene.geometry();
  shifted.origin_x_m -= 1.0;
  shifted.origin_y_m -= 0.5;
  shifted.width = 40;
  shifted.height = 30;
  MapSnapshot map = BlankMap(shifted);
  const Point2 at = scene.geometry().Center(testing::CellInArt(kArt, 'A'));
  map.occupancy[shifted.CellAt(at)] = CellState::kFree;
  map.gas_mean_ppm[shifted.CellAt(at)] = 10.0F;
  map.gas_variance_ppm2[shifted.CellAt(at)] = 0.25F;
  const MapMetrics metrics = Evaluate(scene, map);
  EXPECT_NEAR(metrics.completeness, 1.0 / 6.0, kRounding);
  EXPECT_NEAR(metrics.rmse_ppm, std::sqrt(16.0 / 2.0), kRounding);
  EXPECT_NEAR(metrics.entropy_nats, Entropy(0.25) + Entropy(0.3), kRounding);
}

TEST(MetricsTest, NoiseThatTheMapEstimatesIsAlsoWhereItHasNoEstimate) {
  const Scene scene = MakeScene();
  MapSnapshot map = BlankMap(scene.geometry());
  map.gas_quality.clean_air_scale = 40.0;
  const MapMetrics metrics = Evaluate(scene, map);
  EXPECT_NEAR(metrics.entropy_nats, 2.0 * Entropy(40.0 * kPriorVariance_ppm2), kRounding);
}

TEST(MetricsTest, HasNoErrorsToTellWithoutCriticalCells) {
  Scene scene = MakeScene();
  scene.critical_threshold_ppm = 10.0;
  const MapMetrics metrics = Evaluate(scene, BlankMap(scene.geometry()));
  EXPECT_EQ(metrics.critical_cells, 0);
  EXPECT_TRUE(std::isnan(metrics.rmse_ppm));
  EXPECT_TRUE(std::isnan(metrics.rmse_zero_ppm));
  EXPECT_TRUE(std::isnan(metrics.entropy_nats));
}

TEST(MetricsTest, JudgesTheSumOfAmbientAirAndGas) {
  const Scene scene = MakeScene();
  const MapEvaluator evaluator(scene, kPriorVariance_ppm2, 400.0);
  MapSnapshot map = BlankMap(scene.geometry());
  const MapMetrics blank = evaluator.Evaluate(map);
  EXPECT_EQ(blank.critical_cells, 2) << "the threshold is that of the scene's gas";
  EXPECT_NEAR(blank.rmse_ppm, std::sqrt(58.0), kRounding) << "a blank map says clean air";
  EXPECT_NEAR(blank.rmse_zero_ppm, std::sqrt(58.0), kRounding);
  map.gas_mean_ppm[testing::CellInArt(kArt, 'A')] = 407.0F;
  map.gas_variance_ppm2[testing::CellInArt(kArt, 'A')] = 0.125F;
  EXPECT_NEAR(evaluator.Evaluate(map).rmse_ppm, std::sqrt(25.0 / 2.0), kRounding);
}

}  // namespace metrics_test
}  // namespace plumescout::lab
