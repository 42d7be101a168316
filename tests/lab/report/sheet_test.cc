// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/sheet.h"

#include <gtest/gtest.h>

#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "tests/support/small_report.h"

namespace plumescout::lab {
namespace {

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

TEST(Sheet, ASheetOfNothingIsStillASheet) { EXPECT_GT(DrawSheet({}).height(), kChartHeight_px); }

}  // namespace
}  // namespace plumescout::lab
