// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/calibration_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout::lab {
namespace calibration_table_test {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pair;
using ::testing::SizeIs;

MapCalibration MapOf(double within_1_sigma, double rms_z, int cells) {
  MapCalibration map;
  map.nlpd_nats = 2.0 * rms_z;
  map.within_1_sigma = within_1_sigma;
  map.within_2_sigma = 1.0;
  map.rms_z = rms_z;
  map.estimated_cells = cells;
  return map;
}

// Of a mission that came to no critical cell.
MapCalibration Nothing() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return {kNan, kNan, kNan, kNan, kNan, kNan, kNan, 0};
}

TEST(CalibrationTable, MapsCountTheSameAndPooledCellsDo) {
  Study study;
  AddCalibration({{"a", {MapOf(0.5, 1.0, 10), MapOf(1.0, 2.0, 30), Nothing()}}}, study);
  EXPECT_THAT(study.summary.figures,
              AllOf(SizeIs(6), Contains(Pair("a_within_1_sigma", 0.75)),
                    Contains(Pair("a_within_2_sigma", 1.0)), Contains(Pair("a_rms_z", 1.5)),
                    Contains(Pair("a_nlpd_nats", 3.0)),
                    Contains(Pair("a_pooled_within_1_sigma", DoubleNear(0.875, 1e-12))),
                    Contains(Pair("a_pooled_within_2_sigma", 1.0))));
  ASSERT_THAT(study.figures.tables, SizeIs(1));
  const TextTable& table = study.figures.tables[0];
  ASSERT_THAT(table.rows, SizeIs(1));
  EXPECT_THAT(table.rows[0], SizeIs(table.columns.size()));
  EXPECT_THAT(table.rows[0],
              ElementsAre("a", "2 of 3", "40", "0.75", "1.00", "0.88", "1.00", "1.50", "3.00"));
}

TEST(CalibrationTable, WithoutCriticalCellsNothingIsTold) {
  Study study;
  AddCalibration({{"a", {Nothing()}}}, study);
  for (const auto& [name, value] : study.summary.figures) EXPECT_TRUE(std::isnan(value)) << name;
  EXPECT_THAT(study.figures.tables.at(0).rows.at(0),
              ElementsAre("a", "0 of 1", "0", "–", "–", "–", "–", "–", "–"));
}

TEST(CalibrationTable, OneMapIsAKeyNumberAndFigures) {
  Study study;
  AddCalibration(MapOf(0.5, 1.25, 10), study);
  EXPECT_THAT(study.summary.figures,
              ElementsAre(Pair("nlpd_nats", 2.5), Pair("within_1_sigma", 0.5),
                          Pair("within_2_sigma", 1.0), Pair("rms_z", 1.25)));
  EXPECT_THAT(study.figures.key_numbers,
              ElementsAre(Pair(testing::_, "0.50; 1.00; 1.25; 2.50 nats")));
}

TEST(CalibrationTable, ColumnsGoWithRows) {
  CsvTable table;
  table.columns = {"seed"};
  AddCalibrationColumns(table);
  EXPECT_THAT(table.columns,
              ElementsAre("seed", "nlpd_nats", "within_1_sigma", "within_2_sigma", "rms_z"));
  std::vector<double> row = {7.0};
  AddCalibration(MapOf(0.5, 1.25, 10), row);
  EXPECT_THAT(row, ElementsAre(7.0, 2.5, 0.5, 1.0, 1.25));
}

}  // namespace calibration_table_test
}  // namespace plumescout::lab
