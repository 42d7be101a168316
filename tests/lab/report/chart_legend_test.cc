// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/chart_legend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lab/report/font.h"
#include "tests/support/recording_canvas.h"

namespace plumescout::lab {
namespace chart_legend_test {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::Ge;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr Rgb kBlue{0, 0, 255};
constexpr double kWidth_px = 300.0;

std::vector<WrittenText> Write(const std::vector<ChartLegendItem>& items,
                               double width_px = kWidth_px) {
  RecordingCanvas canvas;
  DrawChartLegend(canvas, {10.0, 20.0, width_px, 100.0}, items);
  return canvas.texts;
}

// Seven names of about 100 pixels with their samples: three rows of 300.
std::vector<ChartLegendItem> ManyItems() {
  return std::vector<ChartLegendItem>(7, {"XIT-FGF, ours", {kBlue}});
}

TEST(ChartLegend, AsManyNamesShareARowAsItHolds) {
  const std::vector<WrittenText> one_row = Write({{"a", {kBlue}}, {"b", {kBlue}}});
  ASSERT_THAT(one_row, SizeIs(2));
  EXPECT_EQ(one_row[0].baseline.y, one_row[1].baseline.y);
  EXPECT_GT(one_row[1].baseline.x, one_row[0].right());
}

TEST(ChartLegend, FurtherNamesBeginRowsAtTheLeft) {
  const std::vector<WrittenText> texts = Write(ManyItems());
  ASSERT_THAT(texts, SizeIs(7));
  EXPECT_GT(texts.back().baseline.y, texts.front().baseline.y);
  for (std::size_t i = 1; i < texts.size(); ++i) {
    if (texts[i].baseline.y > texts[i - 1].baseline.y) {
      EXPECT_EQ(texts[i].baseline.x, texts[0].baseline.x) << i;
    } else {
      EXPECT_GT(texts[i].baseline.x, texts[i - 1].right()) << i;
    }
  }
}

TEST(ChartLegend, NoNameGoesBeyondTheBox) {
  for (const double width_px : {60.0, 130.0, 300.0, 448.0}) {
    for (const WrittenText& text : Write(ManyItems(), width_px)) {
      EXPECT_LE(text.right(), 10.0 + width_px) << text.utf8;
    }
  }
}

TEST(ChartLegend, ItsHeightHoldsItsRows) {
  for (const double width_px : {130.0, 300.0, 448.0}) {
    const double height_px = ChartLegendHeight_px(ManyItems(), width_px);
    EXPECT_LE(Write(ManyItems(), width_px).back().baseline.y, 20.0 + height_px) << width_px;
  }
  EXPECT_GT(ChartLegendHeight_px(ManyItems(), 130.0), ChartLegendHeight_px(ManyItems(), 300.0));
}

TEST(ChartLegend, WithoutItemsThereIsNothing) {
  EXPECT_EQ(ChartLegendHeight_px({}, kWidth_px), 0.0);
  EXPECT_THAT(Write({}), IsEmpty());
}

TEST(ChartLegend, ANameThatIsTooLongIsCut) {
  const std::string name(100, 'm');
  const std::vector<WrittenText> texts = Write({{name, {kBlue}}});
  ASSERT_THAT(texts, SizeIs(1));
  EXPECT_THAT(texts[0].utf8, AllOf(StartsWith("mmm"), EndsWith("m...")));
  // Not by more than it must: one more letter would not fit.
  EXPECT_GT(texts[0].right() + TextWidth_px("mm", 13.0), 10.0 + kWidth_px);
}

TEST(ChartLegend, ACharacterIsNotCutInItsMiddle) {
  std::string name;
  for (int i = 0; i < 60; ++i) name += "\u20AC";
  for (double width_px = 100.0; width_px < 130.0; width_px += 1.0) {
    const std::vector<WrittenText> texts = Write({{name, {kBlue}}}, width_px);
    ASSERT_THAT(texts, SizeIs(1));
    const std::size_t kept = texts[0].utf8.size() - std::string("...").size();
    EXPECT_THAT(kept, Ge(3u));
    EXPECT_EQ(kept % 3, 0u);  // the sign has three bytes
    EXPECT_THAT(texts[0].utf8, EndsWith("\u20AC..."));
  }
}

TEST(ChartLegend, ABoxWithoutWidthGetsNoLetters) {
  const std::vector<WrittenText> texts = Write({{"name", {kBlue}}}, 0.0);
  ASSERT_THAT(texts, SizeIs(1));
  EXPECT_EQ(texts[0].utf8, "...");
}

TEST(ChartLegend, SamplesAreLinesSquaresOrDots) {
  RecordingCanvas canvas;
  DrawChartLegend(canvas, {0.0, 0.0, kWidth_px, 100.0},
                  {{"line", {kBlue, 2.0, 4.0}, LegendSample::kLine},
                   {"square", {kBlue}, LegendSample::kSquare},
                   {"dot", {kBlue, 6.0}, LegendSample::kDot}});
  ASSERT_THAT(canvas.lines, SizeIs(1));
  EXPECT_EQ(canvas.lines[0].stroke.dash_px, 4.0);
  EXPECT_THAT(canvas.boxes, SizeIs(1));
  ASSERT_THAT(canvas.discs, SizeIs(1));
  EXPECT_EQ(canvas.discs[0].radius_px, 3.0);
}

}  // namespace chart_legend_test
}  // namespace plumescout::lab
