// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/number_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace number_labels_test {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(NumberLabels, FiguresHaveNamesAndUnits) {
  const Summary summary{{{"plan_cpu_ms_p50", 19.04},
                         {"completeness", 0.9871},
                         {"readings_sent", 1023.0},
                         {"rmse_ppm", 0.01234},
                         {"within_2_sigma", 0.905},
                         {"mission_complete", 1.0},
                         {"closest_m", std::nan("")},
                         {"something_else", 2.5}},
                        {{"build_type", "Release"}, {"other", "text"}}};
  EXPECT_THAT(LabelledNumbers(summary),
              ElementsAre(Pair("Plan, CPU, median", "19 ms"), Pair("Map complete", "98.7 %"),
                          Pair("Gas readings sent", "1023"), Pair("Gas map, RMSE", "0.0123 ppm"),
                          Pair("Critical cells within 2 σ (ideal: 95 %)", "90.5 %"),
                          Pair("Mission complete", "yes"), Pair("something_else", "2.5"),
                          Pair("Build", "Release"), Pair("other", "text")));
}

}  // namespace number_labels_test
}  // namespace plumescout::lab
