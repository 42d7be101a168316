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
  const auto pictures = PictureTimes(plan, 0, 0, {10.0, 1e6, 2e6});
  ASSERT_TRUE(pictures.ok()) << pictures.status();
  ASSERT_THAT(pictures->means, SizeIs(3));
  ASSERT_THAT(pictures->variances, SizeIs(3));
  EXPECT_LT(pictures->means[0].lines.size(), pictures->means[1].lines.size());
  EXPECT_EQ(pictures->means[1].title, pictures->means[2].title);
  EXPECT_THAT(pictures->variances[0].title, StartsWith("variance"));
}

TEST(SamplingPictures, TheStageHasStartsSourcesAndTheWay) {
  const auto stage = StagePanel(SmallSampling(""), 0, 0, 0.5);
  ASSERT_TRUE(stage.ok()) << stage.status();
  ASSERT_THAT(stage->marks, SizeIs(3));  // two starts and a source
  EXPECT_EQ(stage->marks[0].position, (Point2{0.5, 0.5}));
  EXPECT_EQ(stage->marks[1].position, (Point2{5.5, 4.5}));
  EXPECT_EQ(stage->marks[2].shape, MarkShape::kCross);
  constexpr std::size_t kSites = 29;
  EXPECT_THAT(stage->lines, SizeIs(1 + 2 * kSites));
  EXPECT_GE(stage->lines[0].points.size(), kSites - 1);
}

TEST(SamplingPictures, MarkTheSourcesOfTheTruth) {
  const MapPanel panel = TruthPanel(SmallYard());
  ASSERT_THAT(panel.marks, SizeIs(1));
  EXPECT_EQ(panel.marks[0].position, (Point2{5.5, 2.5}));
}

SamplingDrive DriveOf(const ErrorCurve& errors) {
  SamplingDrive drive;
  drive.errors = errors;
  return drive;
}

// Two worlds, the first with two drives: means of worlds are averaged, not those of drives.
TEST(SamplingPictures, ChartMeansOverWorldsBesideTheReference) {
  SamplingPlan plan;
  plan.worlds.resize(2);
  plan.cases = {{"a", 0, {}, 1}, {"b", 0, {}, 1}, {"c", 1, {}, 1}};
  const SamplingDrive flat = DriveOf({{0.0, 1.0}, {120.0, 1.0}});
  SamplingDrive early = DriveOf({{0.0, 2.0}, {60.0, 0.0}});  // ended early
  early.source_s = 30.0;
  const NamedDrives row = {"row", {DriveOf({{0.0, 4.0}, {120.0, 2.0}}), early, flat}};
  const std::vector<Chart> charts =
      MakeErrorCharts(plan, {"sweep", {flat, flat, flat}}, {row, row});
  ASSERT_THAT(charts, SizeIs(2));
  EXPECT_THAT(charts[0].title, StartsWith("row"));
  EXPECT_EQ(LegendOf(charts[0]), LegendOf(charts[1]));
  EXPECT_THAT(LegendOf(charts[0]), SizeIs(2));
  ASSERT_THAT(charts[0].curves, SizeIs(8));  // bounds, mean and dot, twice
  const Curve& sweep = charts[0].curves[2];
  EXPECT_EQ(sweep.points.front().y, 1.0);
  EXPECT_EQ(charts[0].curves[0].points.front().y, 1.0) << "no spread";
  EXPECT_TRUE(charts[0].curves[3].points.empty()) << "no source was sampled";
  const Curve& mean = charts[0].curves[6];
  EXPECT_EQ(mean.points.front().y, 2.0);          // of 3 and 1
  EXPECT_EQ(mean.points.back().y, 1.0);           // of 1 and 1
  EXPECT_NEAR(mean.points.back().x, 2.0, 0.001);  // minutes
  ASSERT_THAT(charts[0].curves[7].points, SizeIs(1));
  EXPECT_NEAR(charts[0].curves[7].points[0].x, 0.5, 0.01);
  EXPECT_NEAR(charts[0].y_range->high, 2.2, 1e-9);
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
