// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lab/report/raster_canvas.h"
#include "lab/report/svg_canvas.h"

namespace plumescout::lab {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr Rgb kBlue{0, 0, 255};
constexpr Box kBox{0.0, 0.0, 400.0, 300.0};

std::string Svg(const Chart& chart) {
  SvgCanvas canvas(400, 300, "");
  DrawChart(canvas, kBox, chart);
  return canvas.Element();
}

Curve MakeCurve(const std::string& name, const std::vector<ChartPoint>& points) {
  return {name, {kBlue, 2.0}, points};
}

TEST(Chart, TitlesAndTicksArePrinted) {
  const std::string svg =
      Svg({"RMSE, ppm", "time, s", Range{0.0, 1.0}, {MakeCurve("a", {{0, 0.1}, {300, 0.9}})}});
  for (const char* text : {">RMSE, ppm<", ">time, s<", ">0.2<", ">1<", ">100<", ">300<"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

TEST(Chart, OneCurveNeedsNoLegendButTwoDo) {
  const Curve first = MakeCurve("first", {{0, 1}, {1, 2}});
  const Curve second = MakeCurve("second", {{0, 2}, {1, 1}});
  EXPECT_THAT(Svg({"", "", {}, {first}}), Not(HasSubstr("first")));
  EXPECT_THAT(Svg({"", "", {}, {first, second}}), HasSubstr("first"));
}

TEST(Chart, ACurveWithoutANameIsDrawnButNotInTheLegend) {
  const Curve named = MakeCurve("first", {{0, 1}, {1, 2}});
  const Curve other = MakeCurve("second", {{0, 2}, {1, 1}});
  const auto lines = [](const std::string& svg) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = svg.find("<path", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  const std::string two = Svg({"", "", {}, {named, other}});
  const std::string one = Svg({"", "", {}, {named, MakeCurve("", {{0, 2}, {1, 1}})}});
  ASSERT_GT(lines(one), 0u);
  EXPECT_EQ(lines(one) + 1, lines(two));  // the sample of the legend is missing
}

TEST(Chart, AQuantityThatIsNeverNegativeStartsAtZero) {
  const std::string svg = Svg({"", "", {}, {MakeCurve("a", {{10, 5}, {20, 40}})}});
  EXPECT_THAT(svg, HasSubstr(">0<"));
}

TEST(Chart, CurvesRiseFromLeftToRight) {
  RasterCanvas canvas(400, 300, {255, 255, 255});
  DrawChart(canvas, kBox, {"", "", Range{0.0, 1.0}, {MakeCurve("a", {{0, 0}, {1, 1}})}});
  // The plot area is 338 x 226 pixels from (52, 34).
  EXPECT_EQ(canvas.image().At(52 + 338 / 4, 34 + 3 * 226 / 4), kBlue);
  EXPECT_EQ(canvas.image().At(52 + 3 * 338 / 4, 34 + 226 / 4), kBlue);
}

TEST(Chart, ChartsWithoutUsableValuesAreStillDrawn) {
  const double nan = std::nan("");
  for (const std::vector<ChartPoint>& points : {std::vector<ChartPoint>{},
                                                {{0, nan}, {1, nan}},
                                                {{5, 3}},
                                                {{0, 0}, {1, 0}},
                                                {{0, 7}, {0, 7}},
                                                {{0, -1e300}, {1, 1e300}}}) {
    const std::string svg = Svg({"title", "", {}, {MakeCurve("a", points)}});
    EXPECT_THAT(svg, HasSubstr(">title<"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

}  // namespace
}  // namespace plumescout::lab
