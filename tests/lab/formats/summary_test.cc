// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace summary_test {

std::string Written(const Summary& summary) {
  const TempFolder folder;
  EXPECT_TRUE(WriteSummary(summary, folder.File("summary.json")).ok());
  return *ReadFile(folder.File("summary.json"), 4096);
}

TEST(Summary, FiguresInOrderThenAbout) {
  EXPECT_EQ(Written({{{"rmse_ppm", 0.25}, {"completeness", 1.0}}, {{"seed", "7"}}}), R"({
  "rmse_ppm": 0.25,
  "completeness": 1.0,
  "about": {
    "seed": "7"
  }
}
)");
}

TEST(Summary, WhatWasNotMeasuredIsAbsent) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Written({{{"a", std::nan("")}, {"b", -inf}}, {}}), "{\n  \"about\": {}\n}\n");
}

TEST(Summary, TextsAreEscaped) {
  EXPECT_NE(Written({{}, {{"machine", "a \"b\"\n"}}}).find(R"("a \"b\"\n")"), std::string::npos);
}

TEST(Summary, NamesThatClashAreRefused) {
  const TempFolder folder;
  const std::string path = folder.File("summary.json");
  const absl::StatusCode invalid = absl::StatusCode::kInvalidArgument;
  EXPECT_EQ(WriteSummary({{{"a", 1}, {"a", 2}}, {}}, path).code(), invalid);
  EXPECT_EQ(WriteSummary({{{"about", 1}}, {}}, path).code(), invalid);
  EXPECT_EQ(WriteSummary({{{"", 1}}, {}}, path).code(), invalid);
}

}  // namespace summary_test
}  // namespace plumescout::lab
