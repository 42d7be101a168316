// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/sampling_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/trials/small_sampling.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace sampling_pictures_test {

using ::testing::SizeIs;
using ::testing::StartsWith;

TEST(SamplingPictures, ShowTheUpdatesThatAreAskedFor) {
  const SamplingPlan plan = SmallSampling("");
  const auto panels = PictureUpdates(plan, 1, 0, {1, 2, 1000});
  ASSERT_TRUE(panels.ok()) << panels.status();
  ASSERT_THAT(*panels, SizeIs(2));  // there is no thousandth
  EXPECT_NE((*panels)[0].title, (*panels)[1].title);
  EXPECT_LT((*panels)[0].lines.size(), (*panels)[1].lines.size());  // more sites are sampled
}

TEST(SamplingPictures, ShowTheLastMapOfADriveThatEndedBefore) {
  const SamplingPlan plan = SmallSampling("");
  const auto late = PictureTime(plan, 0, 0, 1e6);
  const auto early = PictureTime(plan, 0, 0, 10.0);
  ASSERT_TRUE(late.ok() && early.ok());
  EXPECT_LT(early->lines.size(), late->lines.size());
}

TEST(SamplingPictures, MarkTheSourcesOfTheTruth) {
  const MapPanel panel = TruthPanel(SmallYard());
  ASSERT_THAT(panel.marks, SizeIs(1));
  EXPECT_EQ(panel.marks[0].position, (Point2{5.5, 2.5}));
}

TEST(SamplingPictures, ChartTheMeanOverDrives) {
  SamplingDrive a;
  a.errors = {{0.0, 4.0}, {60.0, 2.0}, {120.0, 2.0}};
  SamplingDrive b;
  b.errors = {{0.0, 2.0}, {60.0, 0.0}};  // ended early
  const Chart chart = MakeMeanErrorChart({{"row", {}, {a, b}}}, "RMSE");
  ASSERT_THAT(chart.curves, SizeIs(1));
  EXPECT_EQ(chart.curves[0].points.front().y, 3.0);
  EXPECT_EQ(chart.curves[0].points.back().y, 1.0);
  EXPECT_NEAR(chart.curves[0].points.back().x, 2.0, 0.01);  // minutes
}

TEST(SamplingPictures, ListEveryDrive) {
  const TempFolder folder;
  const SamplingPlan plan = SmallSampling(folder.File("drives"));
  const auto drives = RunSamplingStudy(plan);
  ASSERT_TRUE(drives.ok());
  const CsvTable table = MakeDriveTable(plan, *drives);
  ASSERT_THAT(table.rows, SizeIs(4));
  EXPECT_THAT(table.labels[2][0], StartsWith("random"));
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
}

}  // namespace sampling_pictures_test
}  // namespace plumescout::lab
