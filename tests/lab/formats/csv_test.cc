// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace csv_test {

std::string Written(const CsvTable& table) {
  const TempFolder folder;
  EXPECT_TRUE(WriteCsv(table, folder.File("a.csv")).ok());
  return *ReadFile(folder.File("a.csv"), 4096);
}

TEST(Csv, NamesThenRows) {
  EXPECT_EQ(Written({{"time_s", "rmse_ppm"}, {{0, 1.5}, {0.5, -2e-9}}}),
            "time_s,rmse_ppm\r\n0,1.5\r\n0.5,-2e-09\r\n");
}

TEST(Csv, NumbersReadBackExactly) {
  const double value = 0.1 + 0.2;
  const std::string text = Written({{"x"}, {{value}}});
  EXPECT_EQ(std::stod(text.substr(3)), value);
}

TEST(Csv, WhatWasNotMeasuredIsEmpty) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Written({{"a", "b", "c"}, {{std::nan(""), 1, inf}}}), "a,b,c\r\n,1,\r\n");
}

TEST(Csv, NamesWithSeparatorsAreQuoted) {
  EXPECT_EQ(Written({{"a,b", "say \"x\""}, {}}), "\"a,b\",\"say \"\"x\"\"\"\r\n");
}

TEST(Csv, RowsOfAnotherLengthAreRefused) {
  const TempFolder folder;
  EXPECT_EQ(WriteCsv({{"a", "b"}, {{1}}}, folder.File("a.csv")).code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(Csv, LabelsComeFirstAndAreQuotedWhereNeedBe) {
  EXPECT_EQ(Written({{"x"}, {{1}, {2}}, {"row"}, {{"a"}, {"b, c"}}}),
            "row,x\r\na,1\r\n\"b, c\",2\r\n");
}

TEST(Csv, RowsWithoutTheirLabelsAreRefused) {
  const TempFolder folder;
  for (const std::vector<std::vector<std::string>>& labels :
       {std::vector<std::vector<std::string>>{}, {{}}, {{"a", "b"}}}) {
    EXPECT_EQ(WriteCsv({{"x"}, {{1}}, {"row"}, labels}, folder.File("a.csv")).code(),
              absl::StatusCode::kInvalidArgument);
  }
}

}  // namespace csv_test
}  // namespace plumescout::lab
