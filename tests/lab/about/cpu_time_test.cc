// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/about/cpu_time.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace cpu_time_test {

TEST(MedianCpu, RunsOnceMoreThanItMeasures) {
  int runs = 0;
  EXPECT_GE(MedianCpu_ms(5, [&runs] { ++runs; }), 0.0);
  EXPECT_EQ(runs, 6);
}

}  // namespace cpu_time_test
}  // namespace plumescout::lab
