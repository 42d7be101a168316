// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/chart_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/recording_canvas.h"

namespace plumescout::lab {
namespace chart_frame_test {

constexpr PixelBox kBox{10.0, 20.0, 400.0, 300.0};

TEST(ChartFrame, NothingIsWrittenInThePlotOrBeyondTheBox) {
  RecordingCanvas canvas;
  const PixelBox plot =
      DrawChartFrame(canvas, kBox, std::string(80, 'm'), "time, s", {{"a", {}}, {"b", {}}});
  DrawValueLines(canvas, plot, 0.0, 1e-4,
                 [&](double value) { return plot.bottom() - value / 1e-4 * plot.height; });
  DrawBelowPlot(canvas, plot, plot.x + 0.5 * plot.width, "100");
  ASSERT_GT(canvas.texts.size(), 7u);
  for (const WrittenText& text : canvas.texts) {
    const double width_px = text.right() - text.baseline.x;
    const double left = text.style.anchor == Anchor::kEnd      ? text.baseline.x - width_px
                        : text.style.anchor == Anchor::kMiddle ? text.baseline.x - 0.5 * width_px
                                                               : text.baseline.x;
    EXPECT_GE(left, kBox.x - 1e-6) << text.utf8;
    EXPECT_LE(left + width_px, kBox.right() + 0.5) << text.utf8;
    EXPECT_LE(text.baseline.y, kBox.bottom()) << text.utf8;
    const bool beside = left + width_px < plot.x || text.baseline.y < plot.y ||
                        text.baseline.y > plot.bottom() + 10.0;
    EXPECT_TRUE(beside) << text.utf8;
  }
}

TEST(ChartFrame, TheLegendTakesItsRoomFromThePlot) {
  RecordingCanvas canvas;
  const PixelBox without = DrawChartFrame(canvas, kBox, "", "", {});
  const PixelBox with = DrawChartFrame(canvas, kBox, "", "", {{"a", {}}});
  EXPECT_EQ(with.y - without.y, ChartLegendHeight_px({{"a", {}}}, kBox.width));
  EXPECT_EQ(with.bottom(), without.bottom());
}

}  // namespace chart_frame_test
}  // namespace plumescout::lab
