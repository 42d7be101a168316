// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/bar_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lab/report/cairo_canvas.h"
#include "tests/support/recording_canvas.h"

namespace plumescout::lab {
namespace bar_chart_test {

using testing::HasSubstr;
using testing::Not;

constexpr Rgb kBlue{0, 0, 255};
constexpr Rgb kRed{255, 0, 0};
constexpr Rgb kWhite{255, 255, 255};
constexpr PixelBox kBox{0.0, 0.0, 400.0, 300.0};

BarChart TwoByTwo() {
  return {"Share, %",
          "trajectory",
          {"one", "two"},
          {{"ours", kBlue, {{50.0}, {100.0}}}, {"theirs", kRed, {{100.0}, {25.0}}}},
          ""};
}

std::string Texts(const BarChart& chart) {
  RecordingCanvas canvas;
  DrawBarChart(canvas, kBox, chart);
  return canvas.Texts();
}

Image Raster(const BarChart& chart) {
  return DrawImage(400, 300, kWhite, [&](Canvas& canvas) { DrawBarChart(canvas, kBox, chart); });
}

// Rows of a colour in one column of pixels.
int Height(const Image& image, int x, Rgb color) {
  int rows = 0;
  for (int y = 0; y < image.height(); ++y) rows += image.At(x, y) == color ? 1 : 0;
  return rows;
}

TEST(BarChart, NamesTitleAxesGroupsAndSeries) {
  const std::string texts = Texts(TwoByTwo());
  for (const char* text : {">Share, %<", ">trajectory<", ">one<", ">two<", ">ours<", ">theirs<"}) {
    EXPECT_THAT(texts, HasSubstr(text));
  }
  EXPECT_THAT(texts, Not(HasSubstr("paper")));
}

// The plot area is 338 x 200 pixels from (52, 60); a bar is 0.4 of half of it wide.
TEST(BarChart, BarsAreAsHighAsTheirValues) {
  const Image image = Raster(TwoByTwo());
  const int first = 52 + 17 + 30;
  const int width = 67;
  const int full = Height(image, first + width, kRed);
  EXPECT_NEAR(full, 200 / 1.06, 2);
  EXPECT_NEAR(Height(image, first, kBlue), full / 2, 2);
  EXPECT_NEAR(Height(image, first + 169, kBlue), full, 2);
  EXPECT_NEAR(Height(image, first + 169 + width, kRed), full / 4, 2);
}

TEST(BarChart, IntervalsAndReferencesAreDrawnIfTheyAreThere) {
  const Image plain = Raster(TwoByTwo());
  BarChart chart = TwoByTwo();
  chart.series[0].bars[0].low = 40.0;
  chart.series[0].bars[0].high = 60.0;
  const Image with_interval = Raster(chart);
  EXPECT_NE(with_interval, plain);
  chart.series[0].bars[0].reference = 80.0;
  chart.reference_name = "paper";
  EXPECT_NE(Raster(chart), with_interval);
  EXPECT_THAT(Texts(chart), HasSubstr(">paper<"));
}

TEST(BarChart, AHighIntervalStaysInThePlot) {
  BarChart chart = TwoByTwo();
  chart.series[0].bars[1].low = 90.0;
  chart.series[0].bars[1].high = 200.0;
  EXPECT_LT(Height(Raster(chart), 52 + 17 + 30 + 67, kRed), 200 / 2);
}

TEST(BarChart, WithoutUsableValuesItIsStillDrawn) {
  BarChart chart = TwoByTwo();
  for (BarSeries& series : chart.series) {
    for (Bar& bar : series.bars) bar = {NAN, NAN, INFINITY, NAN};
  }
  EXPECT_THAT(Texts(chart), Not(HasSubstr("nan")));
  EXPECT_THAT(Texts({}), Not(HasSubstr("nan")));
  chart.series[0].bars.clear();  // fewer bars than groups
  EXPECT_THAT(Texts(chart), HasSubstr(">ours<"));
}

}  // namespace bar_chart_test
}  // namespace plumescout::lab
