// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lab/report/palette.h"
#include "tests/support/small_report.h"

namespace plumescout::lab {
namespace figures_test {

using testing::ElementsAre;
using testing::Field;
using testing::SizeIs;

// Colour that the panel shows at a point of the map.
Rgb ColorIn(const MapPanel& panel, Point2 point) {
  const CellPicture& cells = panel.cells;
  const double cell_m = cells.region.width_m() / cells.image.width();
  return cells.image.At(static_cast<int>((point.x_m - cells.region.min.x_m) / cell_m),
                        static_cast<int>((cells.region.max.y_m - point.y_m) / cell_m));
}

constexpr Point2 kKnown{1.75, 4.75};
constexpr Point2 kUnknown{7.0, 4.75};
constexpr Point2 kWall{-0.9, 4.75};

TEST(Figures, FourMapsIfTheTruthIsKnownElseThree) {
  ReportData data = MakeSmallReport();
  EXPECT_THAT(
      MakeMapPanels(data),
      ElementsAre(Field(&MapPanel::title, "True gas"), Field(&MapPanel::title, "Estimated mean"),
                  Field(&MapPanel::title, "Uncertainty (variance)"),
                  Field(&MapPanel::title, "Occupancy, frontiers and paths")));
  data.true_gas_ppm.reset();
  EXPECT_THAT(MakeMapPanels(data), SizeIs(3));
}

TEST(Figures, ATeamHasTwoPanelsMore) {
  ReportData data = MakeSmallReport();
  data.team = TeamPicture{{{"a", {}, {}}, {"b", {}, {}}}};
  const auto panels = MakeMapPanels(data);
  ASSERT_THAT(panels, SizeIs(6));
  EXPECT_EQ(panels[4].title, "Live plans as tubes, 0 s");
  EXPECT_EQ(panels[5].legend.size(), 2u);
}

TEST(Figures, CellsWithoutAValueShowTheBackground) {
  const auto panels = MakeMapPanels(MakeSmallReport());
  for (const std::size_t field : {std::size_t{1}, std::size_t{2}}) {
    EXPECT_EQ(ColorIn(panels[field], kUnknown), kUnknownColor);
    EXPECT_EQ(ColorIn(panels[field], kWall), kWallColor);
    EXPECT_NE(ColorIn(panels[field], kKnown), kUnknownColor);
  }
}

TEST(Figures, TruthAndEstimateShareTheirColors) {
  ReportData data = MakeSmallReport();
  data.map.gas_mean_ppm = *data.true_gas_ppm;
  data.map.occupancy = data.truth;
  const auto panels = MakeMapPanels(data);
  EXPECT_EQ(panels[0].cells.image, panels[1].cells.image);
  EXPECT_EQ(panels[0].color_bar->scale.high, 100.0);  // at the source
}

TEST(Figures, AllMapsShowTheSameRegion) {
  for (const MapPanel& panel : MakeMapPanels(MakeSmallReport())) {
    EXPECT_NEAR(panel.region.width_m(), 10.0 + 0.4, 1e-9);
    EXPECT_NEAR(panel.region.height_m(), 5.0 + 0.4, 1e-9);
  }
}

TEST(Figures, OccupancyShowsFrontiersInTheirColors) {
  const MapPanel panel = MakeMapPanels(MakeSmallReport()).back();
  EXPECT_EQ(ColorIn(panel, {4.25, 4.75}), kOccupancyFrontierColor);  // cell (10, 5)
  EXPECT_EQ(ColorIn(panel, {0.75, 3.75}), kGasFrontierColor);        // cell (3, 3)
  EXPECT_EQ(ColorIn(panel, kWall), kOccupiedColor);
  EXPECT_EQ(ColorIn(panel, kKnown), kFreeColor);
  EXPECT_EQ(ColorIn(panel, kUnknown), kUnknownColor);
}

TEST(Figures, PathsGoalsStartsAndSourcesAreMarked) {
  const MapPanel panel = MakeMapPanels(MakeSmallReport()).back();
  ASSERT_THAT(panel.lines, SizeIs(1));
  EXPECT_EQ(panel.lines[0].points.size(), 3U);
  ASSERT_THAT(panel.marks, SizeIs(3));  // the second plan was to stay
  EXPECT_EQ(panel.marks[0].color, kGasFrontierColor);
  EXPECT_EQ(panel.marks[0].position, (Point2{1.0, 4.0}));
  EXPECT_EQ(panel.marks[1].color, kStartColor);
  EXPECT_EQ(panel.marks[2].shape, MarkShape::kCross);
}

TEST(Figures, VarianceOverDecadesIsLogarithmic) {
  ReportData data = MakeSmallReport();
  EXPECT_FALSE(MakeMapPanels(data)[2].color_bar->scale.logarithmic);
  data.map.gas_variance_ppm2.values()[22] = 1000.0F;
  EXPECT_TRUE(MakeMapPanels(data)[2].color_bar->scale.logarithmic);
}

TEST(Figures, AMapWithoutGasOrTruthStillHasScales) {
  ReportData data = MakeSmallReport();
  data.true_gas_ppm.reset();
  data.truth = Grid<CellState>();
  for (float& value : data.map.gas_mean_ppm.values()) value = NAN;
  for (float& value : data.map.gas_variance_ppm2.values()) value = NAN;
  for (const MapPanel& panel : MakeMapPanels(data)) {
    if (!panel.color_bar) continue;
    EXPECT_LT(panel.color_bar->scale.low, panel.color_bar->scale.high);
  }
}

TEST(Figures, ChartsFollowTheMetrics) {
  const auto charts = MakeCharts(MakeSmallReport());
  ASSERT_THAT(charts, SizeIs(3));
  ASSERT_THAT(charts[0].curves, SizeIs(1));
  EXPECT_EQ(charts[0].curves[0].points.back().y, 0.5);
  ASSERT_THAT(charts[1].curves, SizeIs(2));  // with the all-zero map
  EXPECT_EQ(charts[1].curves[0].points.back().y, 10.0);
  EXPECT_EQ(charts[1].curves[1].points.back().y, 40.0);
  EXPECT_EQ(charts[2].curves[0].points.back().x, 200.0);
}

TEST(Figures, WhenTheServerWasKilledIsMarked) {
  ReportData report = MakeSmallReport();
  report.server_killed_s = 120.0;
  const auto charts = MakeCharts(report);
  ASSERT_THAT(charts[0].curves, SizeIs(2));
  EXPECT_EQ(charts[0].curves[1].name, "server killed");
  for (const ChartPoint& point : charts[0].curves[1].points) EXPECT_EQ(point.x, 120.0);
}

}  // namespace figures_test
}  // namespace plumescout::lab
