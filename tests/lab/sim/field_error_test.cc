// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/field_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/small_scene.h"

namespace plumescout::lab {
namespace field_error_test {

// Free cells of the small scene hold x + 0.1 y for x in 1 ... 3, y in 1 ... 2.
constexpr int kFreeCells = 6;

MapSnapshot MapSaying(const GridGeometry& geometry, float mean_ppm) {
  MapSnapshot map;
  map.gas_mean_ppm = Grid<float>(geometry, mean_ppm);
  return map;
}

TEST(FieldErrorTest, IsTheRootMeanSquareOverTheFreeCells) {
  const Scene truth = MakeSmallScene();
  double squares = 0.0;
  for (const double mean : {1.1, 2.1, 3.1, 1.2, 2.2, 3.2}) squares += std::pow(mean - 2.0, 2.0);
  EXPECT_NEAR(FieldRmse_ppm(truth, MapSaying(truth.geometry(), 2.0F)),
              std::sqrt(squares / kFreeCells), 1e-6);  // truths are floats
}

TEST(FieldErrorTest, IsZeroForTheTruth) {
  const Scene truth = MakeSmallScene();
  MapSnapshot map;
  map.gas_mean_ppm = truth.conc_mean_ppm;
  EXPECT_EQ(FieldRmse_ppm(truth, map), 0.0);
}

TEST(FieldErrorTest, WithoutAnEstimateTheMapSaysTheBackground) {
  const Scene truth = MakeSmallScene();
  const double at_two = FieldRmse_ppm(truth, MapSaying(truth.geometry(), 2.0F));
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(FieldRmse_ppm(truth, MapSaying(truth.geometry(), none), 2.0), at_two);
  EXPECT_EQ(FieldRmse_ppm(truth, MapSnapshot{}, 2.0), at_two);
}

TEST(FieldErrorTest, LooksCellsUpWhereTheyLie) {
  const Scene truth = MakeSmallScene();
  GridGeometry larger = truth.geometry();
  larger.origin_x_m -= 3.0 * larger.resolution_m;
  larger.origin_y_m -= 2.0 * larger.resolution_m;
  larger.width += 7;
  larger.height += 5;
  MapSnapshot map = MapSaying(larger, 1000.0F);
  for (std::size_t i = 0; i < truth.occupancy.size(); ++i) {
    const Cell cell = truth.geometry().CellAtIndex(i);
    map.gas_mean_ppm[Cell{cell.x + 3, cell.y + 2}] = truth.conc_mean_ppm[i];
  }
  EXPECT_EQ(FieldRmse_ppm(truth, map), 0.0);
}

TEST(FieldErrorTest, IsNoNumberWithoutFreeCells) {
  Scene truth = MakeSmallScene();
  truth.occupancy = Grid<CellState>(truth.geometry(), CellState::kOccupied);
  EXPECT_TRUE(std::isnan(FieldRmse_ppm(truth, MapSaying(truth.geometry(), 1.0F))));
}

}  // namespace field_error_test
}  // namespace plumescout::lab
