// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/map_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lab/report/cairo_canvas.h"
#include "tests/support/recording_canvas.h"

namespace plumescout::lab {
namespace map_panel_test {

using testing::HasSubstr;

constexpr Rgb kGreen{0, 200, 0};
constexpr Rgb kBlue{0, 0, 255};
const GridGeometry kGeometry{10.0, 20.0, 0.5, 4, 2};  // 2 m x 1 m

MapPanel MakePanel() {
  MapPanel panel;
  panel.title = "Gas";
  panel.region = RegionOf(kGeometry);
  panel.cells = PaintCells(kGeometry, panel.region, [](Cell cell) {
    return cell == Cell{3, 1} ? kGreen : Rgb{};
  });
  return panel;
}

RecordingCanvas Draw(const MapPanel& panel) {
  RecordingCanvas canvas;
  DrawMapPanel(canvas, {0.0, 0.0, 400.0, 400.0}, panel);
  return canvas;
}

std::string Texts(const MapPanel& panel) { return Draw(panel).Texts(); }

WrittenText TextOf(const MapPanel& panel, const std::string& utf8) {
  for (const WrittenText& text : Draw(panel).texts) {
    if (text.utf8 == utf8) return text;
  }
  ADD_FAILURE() << utf8 << " is not written";
  return {};
}

TEST(MapPanel, RegionsCoverTheirCells) {
  const Rectangle region = RegionOf(kGeometry);
  EXPECT_EQ(region.min, (Point2{10.0, 20.0}));
  EXPECT_EQ(region.max, (Point2{12.0, 21.0}));
  const Rectangle both = region.With({{9.0, 20.5}, {11.0, 30.0}});
  EXPECT_EQ(both.min, (Point2{9.0, 20.0}));
  EXPECT_EQ(both.max, (Point2{12.0, 30.0}));
}

TEST(MapPanel, ThePictureHasNorthUp) {
  const CellPicture picture = MakePanel().cells;
  ASSERT_EQ(picture.image.width(), 4);
  ASSERT_EQ(picture.image.height(), 2);
  EXPECT_EQ(picture.image.At(3, 0), kGreen);  // cell (3, 1) is the north-eastern one
}

TEST(MapPanel, OnlyCellsOfTheRegionArePainted) {
  const CellPicture part = PaintCells(kGeometry, {{10.6, 20.1}, {11.4, 20.4}},
                                      [](Cell cell) { return cell.x == 1 ? kGreen : kBlue; });
  ASSERT_EQ(part.image.width(), 2);
  ASSERT_EQ(part.image.height(), 1);
  EXPECT_EQ(part.image.At(0, 0), kGreen);
  EXPECT_EQ(part.region.min, (Point2{10.5, 20.0}));
  EXPECT_EQ(part.region.max, (Point2{11.5, 20.5}));
}

TEST(MapPanel, ARegionWithoutCellsHasAnEmptyPicture) {
  const CellPicture none =
      PaintCells(kGeometry, {{50.0, 50.0}, {60.0, 60.0}}, [](Cell) { return kBlue; });
  EXPECT_TRUE(none.image.pixels().empty());
}

TEST(MapPanel, PanelsAreAsHighAsTheirMapsButBounded) {
  MapPanel panel = MakePanel();
  const double wide_px = MapPanelHeight_px(panel, 400.0);
  panel.region.max.y_m += 1.0;  // twice as high: 400 pixels instead of 200
  EXPECT_DOUBLE_EQ(MapPanelHeight_px(panel, 400.0), wide_px + 200.0);
  panel.region.max.y_m += 1000.0;
  EXPECT_LT(MapPanelHeight_px(panel, 400.0), 1000.0);
}

TEST(MapPanel, CellsLinesAndMarksLieWhereTheyAre) {
  MapPanel panel = MakePanel();
  panel.lines = {{{{10.0, 20.25}, {12.0, 20.25}}, {kBlue, 3.0}}};
  panel.marks = {{MarkShape::kDisc, kBlue, {10.5, 20.75}}};
  const Image image = DrawImage(400, 400, {255, 255, 255}, [&](Canvas& canvas) {
    DrawMapPanel(canvas, {0.0, 0.0, 400.0, 400.0}, panel);
  });
  // 200 pixels a metre; the map's upper left corner is at (0, 34).
  EXPECT_EQ(image.At(350, 34 + 50), kGreen);
  EXPECT_EQ(image.At(200, 34 + 150), kBlue);
  EXPECT_EQ(image.At(100, 34 + 50), kBlue);
  EXPECT_EQ(image.At(250, 34 + 50), Rgb{});
}

TEST(MapPanel, LabelsOfOnePlaceAreBothReadable) {
  MapPanel panel = MakePanel();
  panel.marks = {{MarkShape::kDisc, kBlue, {11.0, 20.5}, "a1"},
                 {MarkShape::kDisc, kBlue, {11.0, 20.5}, "b2"}};
  const PixelPoint first = TextOf(panel, "a1").baseline;
  const PixelPoint second = TextOf(panel, "b2").baseline;
  EXPECT_GT(std::hypot(first.x - second.x, first.y - second.y), 18.0);  // discs do not meet
}

TEST(MapPanel, ALegendStandsBelowTheColorBar) {
  MapPanel panel = MakePanel();
  panel.color_bar = ColorBar{{ColorMap::kGas, 0.0, 1.0, false}, "ppm"};
  panel.legend = {{"one", MarkShape::kDisc, kBlue},
                  {"two", MarkShape::kDisc, kBlue},
                  {"three", MarkShape::kDisc, kBlue},
                  {"four", MarkShape::kDisc, kBlue}};
  const auto y_of = [&](const std::string& text) { return TextOf(panel, text).baseline.y; };
  EXPECT_GT(y_of("one"), y_of("0.4") + 10.0);  // below the ticks
  EXPECT_EQ(y_of("one"), y_of("four"));        // one row
}

TEST(MapPanel, TheScaleBarHasARoundLength) {
  EXPECT_THAT(Texts(MakePanel()), HasSubstr(">0.2 m<"));  // at most a fifth of 2 m
}

// Of a map of 1 m x 4 m in a panel of 400 x 400 pixels: 72.5 pixels wide.
DrawnLine ScaleBarOfATallMap(const std::string& title) {
  MapPanel panel;
  panel.title = title;
  panel.region = {{0.0, 0.0}, {1.0, 4.0}};
  RecordingCanvas canvas;
  DrawMapPanel(canvas, {0.0, 0.0, 400.0, 400.0}, panel);
  return canvas.lines.empty() ? DrawnLine{} : canvas.lines.front();
}

TEST(MapPanel, TheScaleBarEndsAtTheEdgeOfATallMap) {
  const DrawnLine bar = ScaleBarOfATallMap("");
  ASSERT_FALSE(bar.points.empty());
  EXPECT_DOUBLE_EQ(bar.points.back().x, 72.5);
}

TEST(MapPanel, TheScaleBarGivesWayToTheTitle) {
  const std::string title = "Estimated mean";
  const DrawnLine bar = ScaleBarOfATallMap(title);
  ASSERT_FALSE(bar.points.empty());
  EXPECT_GT(bar.points.front().x, TextWidth_px(title, 16.0));
  EXPECT_LT(bar.points.back().x, 400.0);
}

TEST(MapPanel, TallMapsAreNarrowerThanTheirPanel) {
  MapPanel panel = MakePanel();  // 2 m x 1 m
  EXPECT_EQ(MapWidth_px(panel, 400.0), 400.0);
  panel.region.max.y_m += 9.0;
  const double width_px = MapWidth_px(panel, 400.0);
  EXPECT_LT(width_px, 400.0);
  RecordingCanvas canvas;
  DrawMapPanel(canvas, {0.0, 0.0, 400.0, MapPanelHeight_px(panel, 400.0)}, panel);
  ASSERT_FALSE(canvas.boxes.empty());
  EXPECT_DOUBLE_EQ(canvas.boxes.front().width, width_px);  // the ground of the map
}

TEST(MapPanel, TheColorBarPrintsItsUnitAndTicks) {
  MapPanel panel = MakePanel();
  panel.color_bar = ColorBar{{ColorMap::kGas, 0.5, 500.0, true}, "ppm"};
  const std::string texts = Texts(panel);
  for (const char* text : {">ppm<", ">1<", ">10<", ">100<"}) EXPECT_THAT(texts, HasSubstr(text));
}

TEST(MapPanel, ALongUnitEndsWithTheMap) {
  for (const char* unit : {"ppm", "RMSE, ppm", "nats per critical cell"}) {
    MapPanel panel = MakePanel();
    panel.color_bar = ColorBar{{ColorMap::kGas, 0.0, 1.0, false}, unit};
    EXPECT_LE(TextOf(panel, unit).right(), 400.0) << unit;
  }
}

TEST(MapPanel, TheLegendNamesItsEntries) {
  MapPanel panel = MakePanel();
  panel.legend = {{"wall", MarkShape::kSwatch, kBlue},
                  {"path", MarkShape::kLine, kBlue},
                  {"start", MarkShape::kDisc, kBlue},
                  {"source", MarkShape::kCross, kBlue}};
  const std::string texts = Texts(panel);
  for (const char* text : {">wall<", ">path<", ">start<", ">source<"}) {
    EXPECT_THAT(texts, HasSubstr(text));
  }
}

}  // namespace map_panel_test
}  // namespace plumescout::lab
