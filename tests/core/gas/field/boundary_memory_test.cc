// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/boundary_memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace plumescout {
namespace boundary_memory_test {

const std::vector<double> kMean = {1.0, 2.0, -3.0};
const std::vector<double> kCovariance = {5.0, 1.0, 0.5, 1.0, 4.0, 0.2, 0.5, 0.2, 6.0};

TEST(BoundaryMemoryTest, SeesNoMoveWhereThereIsNone) {
  BoundaryMemory memory;
  memory.Remember({kMean, kCovariance});
  const FieldShift moved = memory.Moved({kMean, kCovariance});
  EXPECT_EQ(moved.mean_ppm, 0.0);
  EXPECT_EQ(moved.covariance_ppm2, 0.0);
}

TEST(BoundaryMemoryTest, SeesTheLargestMoveInAnyElement) {
  BoundaryMemory memory;
  memory.Remember({kMean, kCovariance});
  std::vector<double> mean = kMean;
  mean[0] += 0.25;
  mean[2] -= 0.5;
  std::vector<double> covariance = kCovariance;
  covariance[1] -= 0.75;
  covariance[3] -= 0.75;
  covariance[8] += 0.125;
  const FieldShift moved = memory.Moved({mean, covariance});
  EXPECT_EQ(moved.mean_ppm, 0.5);
  EXPECT_EQ(moved.covariance_ppm2, 0.75);
}

TEST(BoundaryMemoryTest, ExpectsWhatItHasHeard) {
  BoundaryMemory memory;
  memory.Remember({kMean, kCovariance});
  const std::vector<double> x = {2.0, 0.0, 1.0};
  memory.Hear({.mean_factor = 0.5, .variance_factor = 0.25}, x);
  std::vector<double> mean = kMean;
  std::vector<double> covariance = kCovariance;
  for (std::size_t i = 0; i < 3; ++i) {
    mean[i] += 0.5 * x[i];
    for (std::size_t j = 0; j < 3; ++j) covariance[i * 3 + j] -= 0.25 * x[i] * x[j];
  }
  const FieldShift moved = memory.Moved({mean, covariance});
  EXPECT_EQ(moved.mean_ppm, 0.0);
  EXPECT_EQ(moved.covariance_ppm2, 0.0);
}

TEST(BoundaryMemoryTest, HoldsTheBoundaryOfARoot) {
  BoundaryMemory memory;
  memory.Remember({});
  memory.Hear({1.0, 1.0}, {});
  EXPECT_EQ(memory.Moved({}).mean_ppm, 0.0);
  EXPECT_EQ(memory.Moved({}).covariance_ppm2, 0.0);
}

}  // namespace boundary_memory_test
}  // namespace plumescout
