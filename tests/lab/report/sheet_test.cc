// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "tests/support/recording_canvas.h"
#include "tests/support/small_report.h"

namespace plumescout::lab {
namespace sheet_test {

ReportFigures MakeFigures() {
  const ReportData data = MakeSmallReport();
  return {data.title, data.key_numbers, MakeMapPanels(data), MakeCharts(data)};
}

TEST(Sheet, HasRoomForFourPanels) {
  const Image sheet = DrawSheet(MakeFigures());
  EXPECT_GT(sheet.width(), 4 * kPanelWidth_px);
  EXPECT_GT(sheet.height(), PanelHeight_px(MakeFigures(), kPanelWidth_px) + kChartHeight_px);
}

TEST(Sheet, EveryPanelLeavesInkInItsColumn) {
  const ReportFigures figures = MakeFigures();
  const Image with = DrawSheet(figures);
  for (std::size_t i = 0; i < figures.panels.size(); ++i) {
    ReportFigures changed = figures;
    changed.panels[i].cells = {};
    EXPECT_NE(DrawSheet(changed), with) << i;
  }
}

TEST(Sheet, AFifthPanelBeginsAnotherRow) {
  ReportFigures figures = MakeFigures();
  ASSERT_EQ(figures.panels.size(), 4u);
  const int height = DrawSheet(figures).height();
  figures.panels.push_back(figures.panels.front());
  EXPECT_GE(DrawSheet(figures).height(), height + PanelHeight_px(figures, kPanelWidth_px));
}

TEST(Sheet, BarChartsStandAfterTheCharts) {
  ReportFigures figures = MakeFigures();
  figures.charts.pop_back();
  const Image without = DrawSheet(figures);
  figures.bar_charts = {{"Shares", "", {"a"}, {{"ours", kInk, {{1.0}}}}, ""}};
  EXPECT_NE(DrawSheet(figures), without);
}

TEST(Sheet, GrowsWithItsTable) {
  ReportFigures figures = MakeFigures();
  const int height = DrawSheet(figures).height();
  figures.key_numbers.resize(40, {"name", "value"});
  EXPECT_GT(DrawSheet(figures).height(), height);
}

TEST(Sheet, GrowsWithItsNotes) {
  ReportFigures figures = MakeFigures();
  const int height = DrawSheet(figures).height();
  figures.notes = {"What is to be seen here."};
  EXPECT_GT(DrawSheet(figures).height(), height);
}

TEST(Sheet, PanelsFillTheFewestRowsOfUpToFour) {
  const MapPanel panel = MakeFigures().panels.front();
  constexpr std::size_t kColumns[] = {4, 4, 3, 4, 3, 3, 4, 4, 3};  // for 1 to 9 panels
  ReportFigures figures;
  for (const std::size_t columns : kColumns) {
    figures.panels.push_back(panel);
    EXPECT_EQ(PanelsPerRow(figures), columns) << figures.panels.size();
  }
}

TEST(Sheet, FiguresMaySayHowManyPanelsARowHas) {
  ReportFigures figures = MakeFigures();
  figures.panels_per_row = 2;
  EXPECT_EQ(PanelsPerRow(figures), 2u);
  EXPECT_GT(DrawSheet(figures).height(), DrawSheet(MakeFigures()).height());
  figures.panels_per_row = 0;
  EXPECT_EQ(PanelsPerRow(figures), 1u);
}

// Columns of pixels in which the two pictures differ: the first, and the last.
std::pair<int, int> DifferentColumns(const Image& a, const Image& b) {
  int first = a.width();
  int last = -1;
  for (int y = 0; y < std::min(a.height(), b.height()); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (a.At(x, y) == b.At(x, y)) continue;
      first = std::min(first, x);
      last = std::max(last, x);
    }
  }
  return {first, last};
}

TEST(Sheet, ARowOfTallMapsStandsInTheMiddle) {
  ReportFigures figures;
  figures.panels.resize(3, MakeFigures().panels.front());
  for (MapPanel& panel : figures.panels) {
    panel.title = "";
    panel.color_bar.reset();
    panel.legend = {};
    panel.region.max.y_m = panel.region.min.y_m + 1.2 * panel.region.width_m();
  }
  ReportFigures changed = figures;
  for (MapPanel& panel : changed.panels) {
    const Point2 corner = panel.region.min;
    const GridGeometry cells{corner.x_m, corner.y_m, 0.1 * panel.region.width_m(), 10, 12};
    panel.cells = PaintCells(cells, panel.region, [](Cell) { return kSourceColor; });
  }
  const Image sheet = DrawSheet(figures);
  const auto [first, last] = DifferentColumns(sheet, DrawSheet(changed));
  EXPECT_GT(first, 100);  // beyond the margin of 40 pixels
  EXPECT_NEAR(first, sheet.width() - 1 - last, 2);
}

TEST(Sheet, GrowsWithItsFirstTableIfThatFits) {
  ReportFigures figures = MakeFigures();
  const int height = DrawSheet(figures).height();
  figures.tables = {{"Table", {"row"}, {{"a"}}}};
  const int with_table = DrawSheet(figures).height();
  EXPECT_GT(with_table, height);
  figures.tables.push_back(figures.tables.front());
  EXPECT_EQ(DrawSheet(figures).height(), with_table);
  figures.tables.front().rows = {{std::string(1000, 'm')}};
  EXPECT_EQ(DrawSheet(figures).height(), height);
}

TEST(Sheet, ChartsAreAsHighAsTheHighestLegendNeeds) {
  ReportFigures figures = MakeFigures();
  const int height = MakeChartDrawings(figures).height_px;
  for (int i = 0; i < 9; ++i) {
    figures.charts[2].curves.push_back({"a curve with a name of its own", {}, {}});
  }
  EXPECT_EQ(MakeChartDrawings(figures).height_px,
            kChartHeight_px +
                std::ceil(ChartLegendHeight_px(LegendOf(figures.charts[2]), kChartWidth_px)));
  EXPECT_GT(MakeChartDrawings(figures).height_px, height);
}

TEST(Sheet, ALegendThatSeveralChartsShareIsDrawnOnce) {
  ReportFigures figures = MakeFigures();
  EXPECT_TRUE(MakeChartDrawings(figures).legend.empty());  // one chart has a legend
  figures.charts.push_back(figures.charts[1]);
  const ChartDrawings shared = MakeChartDrawings(figures);
  EXPECT_EQ(shared.legend, LegendOf(figures.charts[1]));
  EXPECT_EQ(shared.height_px, kChartHeight_px);
  RecordingCanvas canvas;
  for (const ChartDrawing& chart : shared.charts) chart.draw(canvas, {0, 0, 608, 400});
  EXPECT_EQ(canvas.Texts().find("all-zero map"), std::string::npos);
  figures.charts.back().curves[0].stroke.width_px += 1.0;  // others
  EXPECT_TRUE(MakeChartDrawings(figures).legend.empty());
}

TEST(Sheet, AFourthChartBeginsAnotherRow) {
  ReportFigures figures = MakeFigures();
  const int height = DrawSheet(figures).height();
  figures.charts.push_back(figures.charts[0]);
  EXPECT_GE(DrawSheet(figures).height(), height + kChartHeight_px);
}

TEST(Sheet, ASheetOfNothingIsStillASheet) { EXPECT_GT(DrawSheet({}).height(), 100); }

}  // namespace sheet_test
}  // namespace plumescout::lab
