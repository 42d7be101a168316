// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/gaden_slice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gaden_files.h"

namespace plumescout::lab {
namespace gaden_slice_test {

// A hall of 20 x 20 x 10 cells of 0.1 m, free throughout.
GadenEnvironment Hall() {
  GadenEnvironment hall;
  hall.cells = {20, 20, 10};
  hall.cell_size_m = 0.1;
  hall.states.assign(hall.size(), GadenCell::kFree);
  return hall;
}

// One filament of `sigma_cm` that is 100 ppm at its centre, in the middle of cell (10, 10).
GadenFrame OneFilament(double sigma_cm) {
  GadenFrame frame;
  frame.moles_per_cm3 = 1.0;
  frame.moles_per_filament = 1e-4 * std::pow(2.0 * M_PI, 1.5) * std::pow(sigma_cm, 3);
  frame.filaments = {{{1.05, 1.05, 0.5}, sigma_cm}};
  return frame;
}

TEST(GadenSliceTest, AFilamentIsAGaussianUpToThreeSigma) {
  const Grid<float> slice = SliceGadenFrame(Hall(), OneFilament(10.0), 0.5);
  EXPECT_NEAR(slice[Cell(10, 10)], 100.0, 1e-4);
  EXPECT_NEAR(slice[Cell(11, 10)], 100.0 * std::exp(-0.5), 1e-4);
  EXPECT_NEAR(slice[Cell(8, 9)], 100.0 * std::exp(-2.5), 1e-4);
  EXPECT_NEAR(slice[Cell(10, 8)], 100.0 * std::exp(-2.0), 1e-4);
  EXPECT_EQ(slice[Cell(10, 14)], 0.0F);  // four sigma off
}

TEST(GadenSliceTest, HeightIsADistanceToo) {
  const Grid<float> slice = SliceGadenFrame(Hall(), OneFilament(10.0), 0.65);
  EXPECT_NEAR(slice[Cell(10, 10)], 100.0 * std::exp(-0.5 * 1.5 * 1.5), 1e-4);
  EXPECT_EQ(SliceGadenFrame(Hall(), OneFilament(10.0), 0.85)[Cell(10, 10)], 0.0F);
}

TEST(GadenSliceTest, FilamentsAddUp) {
  GadenFrame frame = OneFilament(10.0);
  frame.filaments.push_back(frame.filaments[0]);
  EXPECT_NEAR(SliceGadenFrame(Hall(), frame, 0.5)[Cell(10, 10)], 200.0, 2e-4);
}

TEST(GadenSliceTest, WallsKeepGasBack) {
  GadenEnvironment hall = Hall();
  for (int z = 0; z < 10; ++z) {
    for (int y = 0; y < 20; ++y) hall.states[hall.Index(12, y, z)] = GadenCell::kObstacle;
  }
  const Grid<float> slice = SliceGadenFrame(hall, OneFilament(20.0), 0.5);
  EXPECT_GT(slice[Cell(11, 10)], 0.0F);
  EXPECT_EQ(slice[Cell(12, 10)], 0.0F);  // in the wall
  EXPECT_EQ(slice[Cell(13, 10)], 0.0F);  // behind it, 0.3 m off
  EXPECT_GT(slice[Cell(7, 10)], 0.0F);   // as far on the other side
}

TEST(GadenSliceTest, ConcentrationsAreThoseOfTheLayer) {
  const GadenEnvironment room = support::GadenRoom();
  GadenFrame frame;
  for (std::size_t i = 0; i < room.size(); ++i) {
    frame.concentrations_ppm.push_back(static_cast<float>(i));
  }
  EXPECT_EQ(LayerAt(room, 1.2), 2);
  const Grid<float> slice = SliceGadenFrame(room, frame, 1.2);
  EXPECT_EQ(slice[Cell(3, 2)], static_cast<float>(room.Index(3, 2, 2)));
  EXPECT_EQ(slice[Cell(0, 2)], 0.0F);  // an obstacle
}

TEST(GadenSliceTest, FilamentsOutsideAreNotSeen) {
  GadenFrame frame = OneFilament(20.0);
  frame.filaments[0].position_m = {-0.05, 1.05, 0.5};
  const Grid<float> slice = SliceGadenFrame(Hall(), frame, 0.5);
  EXPECT_EQ(slice[Cell(0, 10)], 0.0F);
}

}  // namespace gaden_slice_test
}  // namespace plumescout::lab
