// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/wind_validation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lab/worlds/published_flows.h"
#include "tests/lab/studies/study_figures.h"

namespace plumescout::lab {
namespace wind_validation_test {

// Run once: all tests look at the same.
const Study& Quick() {
  static const Study study = [] {
    ExperimentOptions options;
    options.quick = true;
    return RunWindValidation(options).value();
  }();
  return study;
}

double Figure(const std::string& name) { return FigureOf(Quick(), name); }

// Bars: what second order leaves at these cells by the full study's rasters (0.0031, 0.0044, 0.0034
// at 32 cells, a quarter of each at 64), and a quarter more.
TEST(WindValidation, ComesCloseToTheSpectralCavity) {
  EXPECT_NEAR(Figure("cavity_re100_n32_least_u"), kCavityLeastU100, 0.004);
  EXPECT_NEAR(Figure("cavity_re100_n32_least_v"), kCavityLeastV100, 0.0055);
  EXPECT_NEAR(Figure("cavity_re100_n32_greatest_v"), kCavityGreatestV100, 0.0043);
}

// First-order upwinding is off by 0.066 and 0.079 at Re = 400 on these 32 cells.
TEST(WindValidation, ComesCloseToGhiasProfiles) {
  EXPECT_LT(Figure("cavity_re100_n32_u_rms_off_ghia"), 0.005);
  EXPECT_LT(Figure("cavity_re100_n32_v_rms_off_ghia"), 0.005);
  EXPECT_LT(Figure("cavity_re400_n32_u_rms_off_ghia"), 0.025);
  EXPECT_LT(Figure("cavity_re400_n32_v_rms_off_ghia"), 0.025);
}

// The parabola's mirror image at the wall is off by h^2 / 4 times half its bend, less its mean: u =
// (y (1 - y) + h^2 / 4) / (1 / 6 + h^2 / 3), to be compared with 6 y (1 - y). Up to second order in
// h, h^2 (1.5 - 2 * 6 y (1 - y)) at the wall's face.
TEST(WindValidation, ConvergesToPoiseuilleToSecondOrder) {
  const double coarse = Figure("channel_n8_largest_error");
  const double fine = Figure("channel_n16_largest_error");
  EXPECT_NEAR(fine, 1.5 / (16.0 * 16.0), 0.1 * fine);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

// Within the 3 % to which their correlation is said to hold, and one of our cells.
TEST(WindValidation, HasTheEntranceLengthOfDurst) {
  const double published = Figure("channel_entrance_durst");
  EXPECT_NEAR(Figure("channel_n16_entrance"), published, 0.03 * published + 1.0 / 16.0);
}

// Errors of 4.8 % and 5.7 % on these coarse rasters; 1.3 % and 0.9 % on the full study's.
TEST(WindValidation, ReattachesBehindTheStep) {
  for (const Reattachment& published : kReattachments) {
    const std::string name = "step_re" + std::to_string(static_cast<int>(published.reynolds));
    const double coarse = Figure(name + "_n4_reattachment");
    const double fine = Figure(name + "_n8_reattachment");
    EXPECT_NEAR(fine, published.length, 0.07 * published.length);
    EXPECT_LT(std::abs(fine - published.length), 0.5 * std::abs(coarse - published.length));
  }
}

TEST(WindValidation, ShowsEveryFlow) {
  EXPECT_EQ(Quick().figures.panels.size(), 4u);
  EXPECT_EQ(Quick().figures.charts.size(), 3u);
  // 2 x 15 points on 3 rasters at 2 Reynolds numbers, the channel's faces, 4 steps.
  EXPECT_EQ(Quick().table.rows.size(), 180u + (4u + 8u + 16u) + 4u);
  for (const auto& row : Quick().table.rows) {
    EXPECT_EQ(row.size(), Quick().table.columns.size());
    EXPECT_TRUE(std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); }));
  }
}

}  // namespace wind_validation_test
}  // namespace plumescout::lab
