// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/row_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/report/palette.h"

namespace plumescout::lab {
namespace row_figures_test {

using ::testing::ElementsAre;
using ::testing::SizeIs;

TrialRecord RecordOf(const std::vector<double>& rmse_ppm) {
  TrialRecord record;
  for (std::size_t i = 0; i < rmse_ppm.size(); ++i) {
    MapMetrics metrics;
    metrics.rmse_ppm = rmse_ppm[i];
    metrics.entropy_nats = 10.0 * rmse_ppm[i];
    metrics.critical_cells = 5;
    metrics.completeness = 0.5;
    record.curve.push_back({5.0 * static_cast<double>(i), metrics});
  }
  return record;
}

// Two buildings, two rows, two trials; one trial ends early.
std::vector<SceneRecords> Records() {
  return {{{RecordOf({9, 6}), RecordOf({9, 4})}, {RecordOf({9, 3}), RecordOf({9, 1})}},
          {{RecordOf({9, 8}), RecordOf({9})}, {RecordOf({9, 2}), RecordOf({9, 2})}}};
}

TEST(RowFigures, FinalsAreThoseOfTrialsInOneBuilding) {
  const std::vector<SceneRecords> one = {Records().front()};
  EXPECT_THAT(Finals(one, 0, Rmse_ppm), ElementsAre(6, 4));
  EXPECT_THAT(Finals(one, 1, Rmse_ppm), ElementsAre(3, 1));
  EXPECT_THAT(Finals(one, 1, Entropy_nats), ElementsAre(30, 10));
  EXPECT_THAT(Finals(one, 1, EntropyPerCell_nats), ElementsAre(6, 2));
}

TEST(RowFigures, OfSeveralBuildingsEachCountsOnce) {
  EXPECT_THAT(Finals(Records(), 0, Rmse_ppm), ElementsAre(5, 8.5));
  EXPECT_THAT(Finals(Records(), 1, Rmse_ppm), ElementsAre(2, 2));
  EXPECT_THAT(Finals(Records(), 1, EntropyPerCell_nats), ElementsAre(4, 4));
}

TEST(RowFigures, ARowWhoseTrialsAllEndEarlyGoesOnWithTheOthers) {
  std::vector<SceneRecords> records = {{{RecordOf({9, 6})}, {RecordOf({9, 3, 1})}}};
  const Chart chart = MakeMetricChart(records, {{"a", kInk}, {"b", kInk}}, "RMSE", Rmse_ppm);
  ASSERT_THAT(chart.curves, SizeIs(2));
  ASSERT_THAT(chart.curves[0].points, SizeIs(3));
  EXPECT_DOUBLE_EQ(chart.curves[0].points[2].x, 10.0);
  EXPECT_DOUBLE_EQ(chart.curves[0].points[2].y, 6.0);
}

TEST(RowFigures, CurvesAreMeansAndTrialsThatEndKeepTheirLastValue) {
  const Chart chart =
      MakeMetricChart(Records(), {{"a", kInk, true}, {"b", kInk, false}}, "RMSE", Rmse_ppm);
  ASSERT_THAT(chart.curves, SizeIs(4));  // two bounds and two means
  const Curve& mean = chart.curves[2];
  EXPECT_EQ(mean.name, "a");
  ASSERT_THAT(mean.points, SizeIs(2));
  EXPECT_DOUBLE_EQ(mean.points[1].x, 5.0);
  EXPECT_DOUBLE_EQ(mean.points[1].y, (6 + 4 + 8 + 9) / 4.0);
  EXPECT_LT(chart.curves[0].points[1].y, mean.points[1].y);
  EXPECT_GT(chart.curves[1].points[1].y, mean.points[1].y);
}

TEST(RowFigures, BandsAreMarkedAndDashed) {
  const Chart chart =
      MakeMetricChart(Records(), {{"a", kInk, true}, {"b", kInk, false}}, "RMSE", Rmse_ppm);
  ASSERT_THAT(chart.curves, SizeIs(4));
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const bool bound = i < 2;
    EXPECT_EQ(chart.curves[i].kind, bound ? CurveKind::kBound : CurveKind::kLine) << i;
    EXPECT_EQ(chart.curves[i].stroke.dash_px > 0.0, bound) << i;
    EXPECT_EQ(chart.curves[i].name.empty(), bound) << i;
  }
}

TEST(RowFigures, CompletenessIsShownFromZeroToOne) {
  const Chart chart = MakeMetricChart(Records(), {{"a", kInk, true}}, "Completeness", Completeness);
  ASSERT_TRUE(chart.y_range.has_value());
  EXPECT_EQ(chart.y_range->low, 0.0);
  EXPECT_EQ(chart.y_range->high, 1.0);
  EXPECT_FALSE(MakeMetricChart(Records(), {{"a", kInk, true}}, "RMSE", Rmse_ppm).y_range);
}

TEST(RowFigures, FinalMapsAreThoseOfAllBuildings) {
  TrialPlan plan;
  plan.rows = {{"a", {}}, {"b", {}}};
  std::vector<SceneRecords> records = Records();
  records[1][1][0].calibration.rms_z = 1.5;
  const std::vector<RowMaps> rows = FinalMaps(plan, records, "small_");
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_EQ(rows[1].name, "small_b");
  ASSERT_THAT(rows[1].maps, SizeIs(4));
  EXPECT_EQ(rows[1].maps[2].rms_z, 1.5);
}

TEST(RowFigures, TheTableHasEveryTrial) {
  TrialPlan plan;
  plan.rows = {{"a", {}}, {"b", {}}};
  plan.scenes = {"x/hall", "x/yard"};
  plan.first_seed = 7;
  std::vector<SceneRecords> records = Records();
  records[0][1][1].calibration.rms_z = 1.5;
  const CsvTable table = MakeTrialTable(plan, records);
  ASSERT_THAT(table.rows, SizeIs(8));
  EXPECT_THAT(table.labels[3], ElementsAre("hall", "b"));
  EXPECT_EQ(table.rows[3][0], 8.0);  // the second trial's seed
  EXPECT_EQ(table.rows[3][1], 1.0);
  EXPECT_EQ(table.columns.back(), "rms_z");
  EXPECT_EQ(table.rows[3].back(), 1.5);
  EXPECT_THAT(table.labels[4], ElementsAre("yard", "a"));
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
}

}  // namespace row_figures_test
}  // namespace plumescout::lab
