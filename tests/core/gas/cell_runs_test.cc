// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/cell_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/types/rng.h"

namespace plumescout {
namespace cell_runs_test {

TEST(CellRuns, GiveBackEveryCell) {
  Rng rng(1);
  std::vector<CellInput> cells;
  while (cells.size() < 1000) {
    CellInput input{.active = rng.Below(2) == 0, .linked_north = rng.Below(2) == 0};
    if (rng.Below(3) == 0) input.precision = rng.Uniform(0.0, 10.0);
    cells.insert(cells.end(), 1 + rng.Below(9), input);
  }
  const CellRuns runs(cells);
  EXPECT_EQ(runs.size(), cells.size());
  EXPECT_EQ(runs.Cells(), cells);
}

TEST(CellRuns, KeepSignsOfNothingAndWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<CellInput> cells = {{.weighted_deviation = 0.0},
                                        {.weighted_deviation = -0.0},
                                        {.precision = nan},
                                        {.precision = nan}};
  const std::vector<CellInput> again = CellRuns(cells).Cells();
  ASSERT_EQ(again.size(), cells.size());
  EXPECT_FALSE(std::signbit(again[0].weighted_deviation));
  EXPECT_TRUE(std::signbit(again[1].weighted_deviation));
  EXPECT_TRUE(std::isnan(again[2].precision) && std::isnan(again[3].precision));
}

TEST(CellRuns, OfNoCellAreNone) {
  EXPECT_EQ(CellRuns().size(), 0U);
  EXPECT_TRUE(CellRuns(std::vector<CellInput>()).Cells().empty());
}

}  // namespace cell_runs_test
}  // namespace plumescout
