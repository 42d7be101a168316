// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/team_panels.h"

#include <gtest/gtest.h>

#include "lab/report/palette.h"

namespace plumescout::lab {
namespace team_panels_test {

// Four metres by two, a wall cell in the middle of the north robot's way.
constexpr Cell kWallCell{30, 10};
Grid<CellState> Map() {
  Grid<CellState> map(GridGeometry{0.0, 0.0, 0.1, 40, 20}, CellState::kFree);
  map[kWallCell] = CellState::kOccupied;
  return map;
}

// Along x in so many seconds.
TimedWay Way(double begin_s, double end_s, double y_m, double duration_s) {
  TimedWay way{begin_s, end_s, {}};
  way.trajectory.waypoints = {{{0.5, y_m, 0.0}, 0.0}, {{3.5, y_m, 0.0}, duration_s}};
  way.trajectory.length_m = 3.0;
  way.trajectory.duration_s = duration_s;
  return way;
}

TeamPicture Two() {
  TeamPicture team;
  team.members = {{"north", {}, {Way(10.0, 20.0, 1.05, 10.0)}, 0.75, 0.5, 0.25},
                  {"south", {}, {Way(12.0, 15.0, 0.35, 30.0)}, 0.25, 0.5, 0.75}};
  return team;
}

Rgb ColorIn(const MapPanel& panel, Point2 point) {
  const CellPicture& cells = panel.cells;
  const double cell_m = cells.region.width_m() / cells.image.width();
  return cells.image.At(static_cast<int>((point.x_m - cells.region.min.x_m) / cell_m),
                        static_cast<int>((cells.region.max.y_m - point.y_m) / cell_m));
}

TEST(TeamPanels, TheBusiestMomentHasMostRobotsOnTheirWays) {
  EXPECT_EQ(BusiestMoment_s(Two()), 12.0);
  TeamPicture alone = Two();
  alone.members.pop_back();
  EXPECT_EQ(BusiestMoment_s(alone), 10.0);
  EXPECT_EQ(BusiestMoment_s({}), 0.0);
}

TEST(TeamPanels, TubesAreWhatIsAheadPalerTheLater) {
  const Grid<CellState> map = Map();
  const MapPanel panel = TubesPanel(Two(), map, RegionOf(map.geometry()), 12.0);
  // North has gone a fifth of its way.
  EXPECT_EQ(ColorIn(panel, {1.12, 1.07}), kTeamColors[0]);
  EXPECT_EQ(ColorIn(panel, {0.62, 1.07}), kFreeColor) << "behind it";
  EXPECT_EQ(ColorIn(panel, {1.12, 1.42}), kFreeColor) << "beside it";
  const Rgb ahead = ColorIn(panel, {3.42, 1.07});
  EXPECT_NE(ahead, kTeamColors[0]);
  EXPECT_NE(ahead, kFreeColor);
  EXPECT_GT(ahead.red, kTeamColors[0].red);
  EXPECT_EQ(ColorIn(panel, {0.52, 0.37}), kTeamColors[1]);
  EXPECT_EQ(ColorIn(panel, map.geometry().Center(kWallCell)), kOccupiedColor);
  ASSERT_EQ(panel.marks.size(), 2u);
  EXPECT_EQ(panel.marks[1].label, "2");
  EXPECT_NEAR(panel.marks[0].position.x_m, 1.1, 1e-9);
  EXPECT_EQ(panel.legend.size(), 2u);
}

TEST(TeamPanels, WhoHasNoLivePlanHasNoTube) {
  const Grid<CellState> map = Map();
  const MapPanel panel = TubesPanel(Two(), map, RegionOf(map.geometry()), 15.0);
  EXPECT_EQ(panel.marks.size(), 1u);
  EXPECT_EQ(ColorIn(panel, {0.52, 0.37}), kFreeColor);
}

TEST(TeamPanels, DrivenWaysEndInFullColourAndTheLaterIsOnTop) {
  const Grid<CellState> map = Map();
  TeamPicture team = Two();
  team.members[0].driven = {{0.0, {1.0, 1.0}}, {4.0, {2.0, 1.0}}};
  team.members[1].driven = {{0.0, {2.0, 0.2}}, {8.0, {2.0, 1.0}}};
  const MapPanel panel = DrivenPanel(team, map, RegionOf(map.geometry()));
  EXPECT_EQ(ColorIn(panel, {2.02, 1.02}), kTeamColors[1]);
  const Rgb early = ColorIn(panel, {1.02, 1.02});
  EXPECT_NE(early, kTeamColors[0]);
  EXPECT_NE(early, kFreeColor);
}

TEST(TeamPanels, SharesArePerCent) {
  const BarChart chart = ShareChart(Two());
  EXPECT_EQ(chart.groups, (std::vector<std::string>{"north", "south"}));
  ASSERT_EQ(chart.series.size(), 3u);
  EXPECT_EQ(chart.series[0].bars[0].value, 75.0);
  EXPECT_EQ(chart.series[1].bars[1].value, 50.0);
  EXPECT_EQ(chart.series[2].bars[0].value, 25.0);
}

}  // namespace team_panels_test
}  // namespace plumescout::lab
