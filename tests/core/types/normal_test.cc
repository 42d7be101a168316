// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/normal.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace normal_test {

// From tables.
TEST(NormalQuantile, IsWhatTablesSay) {
  EXPECT_NEAR(NormalQuantile(0.5), 0.0, 1e-12);
  EXPECT_NEAR(NormalQuantile(0.95), 1.6448536269514722, 1e-9);
  EXPECT_NEAR(NormalQuantile(0.9999), 3.7190164854556804, 1e-9);
}

TEST(NormalProbability, IsUndoneByTheQuantile) {
  for (const double z : {-6.0, -1.5, 0.0, 0.25, 3.0}) {
    EXPECT_NEAR(NormalQuantile(NormalProbability(z)), z, 1e-6) << z;
  }
}

}  // namespace normal_test
}  // namespace plumescout
