// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lab/report/cairo_canvas.h"
#include "tests/support/recording_canvas.h"

namespace plumescout::lab {
namespace chart_test {

using testing::HasSubstr;
using testing::Not;

constexpr Rgb kBlue{0, 0, 255};
constexpr Rgb kRed{255, 0, 0};
constexpr PixelBox kBox{0.0, 0.0, 400.0, 300.0};
constexpr PixelBox kPlot{52.0, 34.0, 338.0, 226.0};  // in kBox, without legend

Curve MakeCurve(const std::string& name, const std::vector<ChartPoint>& points) {
  return {name, {kBlue, 2.0}, points};
}

// Red, without a name.
Curve MakeBound(const std::vector<ChartPoint>& points) {
  return {"", {kRed, 1.0, 4.0}, points, CurveKind::kBound};
}

RecordingCanvas Draw(const Chart& chart) {
  RecordingCanvas canvas;
  DrawChart(canvas, kBox, chart);
  return canvas;
}

std::string Texts(const Chart& chart) { return Draw(chart).Texts(); }

Image Picture(const Chart& chart) {
  return DrawImage(400, 300, {255, 255, 255},
                   [&](Canvas& canvas) { DrawChart(canvas, kBox, chart); });
}

std::vector<DrawnLine> LinesOf(Rgb color, const Chart& chart) {
  std::vector<DrawnLine> lines;
  for (const DrawnLine& line : Draw(chart).lines) {
    if (line.stroke.color == color) lines.push_back(line);
  }
  return lines;
}

// The values at the lower and upper edge of the plot area of a chart whose first blue curve is a
// line between these values, which the range holds.
Range RangeShown(const Chart& chart, double first, double last) {
  const std::vector<DrawnLine> lines = LinesOf(kBlue, chart);
  if (lines.empty() || lines[0].points.size() != 2) return {};
  const double first_px = lines[0].points[0].y;
  const double per_px = (last - first) / (lines[0].points[1].y - first_px);
  return {first + (kPlot.bottom() - first_px) * per_px, first + (kPlot.y - first_px) * per_px};
}

TEST(Chart, TitlesAndTicksArePrinted) {
  const std::string texts =
      Texts({"RMSE, ppm", "time, s", Range{0.0, 1.0}, {MakeCurve("a", {{0, 0.1}, {300, 0.9}})}});
  for (const char* text : {">RMSE, ppm<", ">time, s<", ">0.2<", ">1<", ">100<", ">300<"}) {
    EXPECT_THAT(texts, HasSubstr(text));
  }
}

TEST(Chart, OneCurveNeedsNoLegendButTwoDo) {
  const Curve first = MakeCurve("first", {{0, 1}, {1, 2}});
  const Curve second = MakeCurve("second", {{0, 2}, {1, 1}});
  EXPECT_THAT(Texts({"", "", {}, {first}}), Not(HasSubstr("first")));
  EXPECT_THAT(Texts({"", "", {}, {first, second}}), HasSubstr("first"));
}

TEST(Chart, ACurveWithoutANameIsDrawnButNotInTheLegend) {
  const Curve named = MakeCurve("first", {{0, 1}, {1, 2}});
  const Curve other = MakeCurve("second", {{0, 2}, {1, 1}});
  const auto lines = [](const Chart& chart) { return Draw(chart).lines.size(); };
  const std::size_t two = lines({"", "", {}, {named, other}});
  const std::size_t one = lines({"", "", {}, {named, MakeCurve("", {{0, 2}, {1, 1}})}});
  ASSERT_GT(one, 0u);
  EXPECT_EQ(one + 1, two);  // the sample of the legend is missing
}

TEST(Chart, AQuantityThatIsNeverNegativeStartsAtZero) {
  const std::string texts = Texts({"", "", {}, {MakeCurve("a", {{10, 5}, {20, 40}})}});
  EXPECT_THAT(texts, HasSubstr(">0<"));
}

TEST(Chart, CurvesRiseFromLeftToRight) {
  const Image image = Picture({"", "", Range{0.0, 1.0}, {MakeCurve("a", {{0, 0}, {1, 1}})}});
  // The plot area is 338 x 226 pixels from (52, 34).
  EXPECT_EQ(image.At(52 + 338 / 4, 34 + 3 * 226 / 4), kBlue);
  EXPECT_EQ(image.At(52 + 3 * 338 / 4, 34 + 226 / 4), kBlue);
}

TEST(Chart, ChartsWithoutUsableValuesAreStillDrawn) {
  const double nan = std::nan("");
  for (const std::vector<ChartPoint>& points : {std::vector<ChartPoint>{},
                                                {{0, nan}, {1, nan}},
                                                {{5, 3}},
                                                {{0, 0}, {1, 0}},
                                                {{0, 7}, {0, 7}},
                                                {{0, -1e300}, {1, 1e300}}}) {
    const std::string texts = Texts({"title", "", {}, {MakeCurve("a", points)}});
    EXPECT_THAT(texts, HasSubstr(">title<"));
    EXPECT_THAT(texts, Not(HasSubstr("nan")));
    EXPECT_THAT(texts, Not(HasSubstr("inf")));
  }
}

TEST(Chart, CurvesEndAtTheEdgesOfThePlot) {
  // A quarter of the way it leaves through the top, at three quarters it comes back.
  const Chart chart{"", "", Range{0.0, 1.0}, {MakeCurve("", {{0.0, 0.0}, {0.5, 2.0}, {1.0, 0.0}})}};
  const std::vector<DrawnLine> lines = LinesOf(kBlue, chart);
  ASSERT_EQ(lines.size(), 1u);
  constexpr double kSlack_px = 1.0;
  constexpr double kQuarter_px = kPlot.width / 4.0;
  std::vector<PixelPoint> at_top;
  for (const PixelPoint& point : lines[0].points) {
    if (!std::isfinite(point.y)) continue;
    EXPECT_GE(point.y, kPlot.y - kSlack_px);
    EXPECT_LE(point.y, kPlot.bottom() + kSlack_px);
    if (point.y < kPlot.y + kSlack_px) at_top.push_back(point);
  }
  ASSERT_EQ(at_top.size(), 2u);
  EXPECT_NEAR(at_top[0].x, kPlot.x + kQuarter_px, kSlack_px);
  EXPECT_NEAR(at_top[1].x, kPlot.right() - kQuarter_px, kSlack_px);
}

TEST(Chart, ACurveThatLeavesIsNotJoinedAlongTheEdge) {
  const Chart chart{"", "", Range{0.0, 1.0}, {MakeCurve("", {{0.0, 0.0}, {0.5, 2.0}, {1.0, 0.0}})}};
  const Image image = Picture(chart);
  for (int x = 52 + 338 / 4 + 5; x < 52 + 3 * 338 / 4 - 5; ++x) {
    for (int y = 0; y < 34 + 3; ++y) EXPECT_NE(image.At(x, y), kBlue) << x << " " << y;
  }
}

TEST(Chart, ACurveOutsideTheRangeIsNotDrawn) {
  const Chart chart{"", "", Range{0.0, 1.0}, {MakeCurve("", {{0, 2}, {1, 3}})}};
  for (const DrawnLine& line : LinesOf(kBlue, chart)) EXPECT_TRUE(line.points.empty());
}

TEST(Chart, ClippedCurvesStillHaveTheirGaps) {
  const double nan = std::nan("");
  const Chart chart{
      "", "", Range{0.0, 1.0}, {MakeCurve("", {{0, 0}, {1, 1}, {2, nan}, {3, 0}, {4, 1}})}};
  const std::vector<DrawnLine> lines = LinesOf(kBlue, chart);
  ASSERT_EQ(lines.size(), 1u);
  ASSERT_EQ(lines[0].points.size(), 5u);
  EXPECT_FALSE(std::isfinite(lines[0].points[2].y));
}

TEST(Chart, NarrowBoundsAreShownWhole) {
  const Chart chart{"",
                    "",
                    std::nullopt,
                    {MakeCurve("", {{0, 110}, {1, 120}}), MakeBound({{0, 107}, {1, 112}}),
                     MakeBound({{0, 113}, {1, 128}})}};
  const Range shown = RangeShown(chart, 110.0, 120.0);
  EXPECT_LE(shown.low, 107.0);
  EXPECT_GE(shown.high, 128.0);
}

TEST(Chart, BoundsWidenTheRangeByNoMoreThanItself) {
  const Chart chart{"",
                    "",
                    std::nullopt,
                    {MakeCurve("", {{0, 100}, {1, 150}}), MakeBound({{0, -1e4}, {1, -1e4}}),
                     MakeBound({{0, 1e4}, {1, 1e4}})}};
  const Range shown = RangeShown(chart, 100.0, 150.0);
  constexpr double kHeadroom = 0.06 * 150.0;  // of what is shown
  EXPECT_NEAR(shown.high, 200.0 + kHeadroom, 1e-6);
  EXPECT_GE(shown.low, 0.0);
  EXPECT_LE(shown.low, 50.0);
}

TEST(Chart, BoundsOfALevelCurveWidenTheRangeByATenthOfItsValue) {
  const Chart chart{"",
                    "",
                    std::nullopt,
                    {MakeCurve("", {{0, 100}, {1, 100.1}}), MakeBound({{0, 0}, {1, 0}}),
                     MakeBound({{0, 1e4}, {1, 1e4}})}};
  const Range shown = RangeShown(chart, 100.0, 100.1);
  const double headroom = 0.06 * (100.1 - 100.0 + 2.0 * 10.01);
  EXPECT_NEAR(shown.low, 100.0 - 10.01 - headroom, 1e-6);
  EXPECT_NEAR(shown.high, 100.1 + 10.01 + headroom, 1e-6);
}

TEST(Chart, BoundsDoNotGoBelowZeroWhereNoCurveDoes) {
  const Curve low = MakeBound({{0, -30}, {1, -30}});
  const auto lowest_shown = [&](double first) {
    const Curve mean = MakeCurve("", {{0, first}, {1, 40}});
    return RangeShown({"", "", std::nullopt, {mean, low}}, first, 40.0).low;
  };
  EXPECT_NEAR(lowest_shown(5.0), 0.0, 1e-9);
  EXPECT_LT(lowest_shown(-5.0), -30.0);
}

TEST(Chart, BoundsAloneAreShownAsTheyAre) {
  const Chart chart{
      "", "", std::nullopt, {{"", {kBlue, 1.0}, {{0, 10}, {1, 20}}, CurveKind::kBound}}};
  EXPECT_EQ(LinesOf(kBlue, chart).size(), 1u);
  EXPECT_GE(RangeShown(chart, 10.0, 20.0).high, 20.0);
}

TEST(Chart, DotsAreNotJoined) {
  Curve dots = MakeCurve("", {{0, 0}, {1, 1}, {1, std::nan("")}, {1, 5}});
  dots.stroke.width_px = 6.0;
  dots.kind = CurveKind::kDots;
  const RecordingCanvas canvas = Draw({"", "", Range{0.0, 1.0}, {dots}});
  ASSERT_EQ(canvas.discs.size(), 2u);  // that without a place and that beyond the range are not
  EXPECT_EQ(canvas.discs[0].radius_px, 3.0);
  EXPECT_DOUBLE_EQ(canvas.discs[0].center.x, kPlot.x);
  EXPECT_DOUBLE_EQ(canvas.discs[1].center.y, kPlot.y);
}

TEST(Chart, TheLegendTakesItsRoomFromThePlot) {
  const Curve named = MakeCurve("first", {{0, 0}, {1, 1}});
  const Chart one{"", "", Range{0.0, 1.0}, {named}};
  const Chart two{"", "", Range{0.0, 1.0}, {named, MakeCurve("second", {{0, 0}, {1, 1}})}};
  const double legend_px = ChartLegendHeight_px(LegendOf(two), kBox.width);
  EXPECT_TRUE(LegendOf(one).empty());
  ASSERT_GT(legend_px, 0.0);
  EXPECT_DOUBLE_EQ(LinesOf(kBlue, two).back().points[1].y,
                   LinesOf(kBlue, one).back().points[1].y + legend_px);
}

TEST(Chart, ALegendThatStandsElsewhereIsLeftOut) {
  const Chart two{"", "", {}, {MakeCurve("first", {{0, 1}}), MakeCurve("second", {{0, 2}})}};
  RecordingCanvas canvas;
  DrawChart(canvas, kBox, two, {});
  EXPECT_THAT(canvas.Texts(), Not(HasSubstr("first")));
}

}  // namespace chart_test
}  // namespace plumescout::lab
