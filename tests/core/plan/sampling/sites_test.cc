// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/sites.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/site_case.h"

namespace plumescout {
namespace sites_test {

using ::testing::IsEmpty;
using testing::SiteCase;
using ::testing::SizeIs;

constexpr double kRounding = 1e-9;

// A wall with a way round its southern end, and a cell behind walls.
const testing::GridArt kWall = {"...#..#.",  //
                                "...#..##",  //
                                "S..#....",  //
                                "...#....",  //
                                "........"};

const Site* SiteIn(const Sites& sites, Cell cell) {
  for (const Site& site : sites.offered) {
    if (site.cell == cell) return &site;
  }
  return nullptr;
}

// Dijkstra with steps between neighbouring cells, no corner of a closed cell cut.
double GridDistance_m(const Grid<std::uint8_t>& open, Cell from, Cell to) {
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<double> cells(open.size(), std::numeric_limits<double>::infinity());
  const GridGeometry& geometry = open.geometry();
  cells[geometry.Index(from)] = 0.0;
  queue.push({0.0, geometry.Index(from)});
  while (!queue.empty()) {
    const auto [length, index] = queue.top();
    queue.pop();
    if (length > cells[index]) continue;
    const Cell at = geometry.CellAtIndex(index);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell next{at.x + dx, at.y + dy};
        if (open.At(next, 0) == 0 || open.At({at.x + dx, at.y}, 0) == 0 ||
            open.At({at.x, at.y + dy}, 0) == 0) {
          continue;
        }
        const double through = length + std::hypot(dx, dy);
        if (through >= cells[geometry.Index(next)]) continue;
        cells[geometry.Index(next)] = through;
        queue.push({through, geometry.Index(next)});
      }
    }
  }
  return cells[geometry.Index(to)] * geometry.resolution_m;
}

TEST(FindSites, OffersWhatTheRobotCanReachAndHowFarItIs) {
  const SiteCase c(kWall);
  const Sites sites = c.Find();
  // 8 x 5 cells, without 4 + 3 of walls and the one behind them.
  ASSERT_THAT(sites.offered, SizeIs(32));
  EXPECT_THAT(sites.rejected, IsEmpty());
  EXPECT_EQ(SiteIn(sites, {7, 4}), nullptr) << "walled in";
  EXPECT_EQ(SiteIn(sites, {3, 3}), nullptr) << "in a wall";
  for (const Site& site : sites.offered) {
    EXPECT_NEAR(site.travel_m, GridDistance_m(c.reachable, c.start, site.cell), kRounding);
    EXPECT_EQ(site.place, c.At(site.cell));
    EXPECT_EQ(site.index, c.belief.geometry().Index(site.cell));
    EXPECT_FALSE(site.sampled);
  }
}

TEST(FindSites, TakesTheEstimateAboveTheBackground) {
  SiteCase c(testing::OpenArt(4, 1));
  MissionOptions mission;
  mission.gas.background_mean_ppm = 400.0;
  c.SetMission(mission);
  for (int x = 0; x < 4; ++x) testing::SetMean(c.belief, {x, 0}, 400.0F);
  testing::SetMean(c.belief, {2, 0}, 420.0F);
  testing::SetVariance(c.belief, {2, 0}, 0.5F);
  const Sites sites = c.Find();
  EXPECT_NEAR(sites.offered.at(2).mean_ppm, 20.0, kRounding);
  EXPECT_NEAR(sites.offered.at(2).variance_ppm2, 0.5, kRounding);
  EXPECT_NEAR(sites.offered.at(1).mean_ppm, 0.0, kRounding);
  EXPECT_NEAR(sites.map_mean_ppm, 5.0, kRounding) << "20 ppm over four cells";
}

TEST(FindSites, TakesThePriorWhereNothingIsEstimatedYet) {
  SiteCase c(testing::OpenArt(3, 1));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  testing::SetMean(c.belief, {1, 0}, nan);
  testing::SetVariance(c.belief, {1, 0}, nan);
  testing::SetMean(c.belief, {2, 0}, 6.0F);
  const Sites sites = c.Find();
  EXPECT_EQ(sites.offered.at(1).mean_ppm, 0.0);
  EXPECT_EQ(sites.offered.at(1).variance_ppm2, OpenLatticeVariance_ppm2(c.belief.options->gas));
  EXPECT_NEAR(sites.map_mean_ppm, 3.0, kRounding) << "over the two with an estimate";
}

TEST(FindSites, CountsASiteAsSampledByAnyReadingInItsSquare) {
  SiteCase c(testing::OpenArt(6, 3));
  c.options.sites.spacing_m = 0.3;
  testing::SetSampled(c.belief, {{5, 0}});
  const Sites sites = c.Find();
  ASSERT_THAT(sites.offered, SizeIs(2));
  EXPECT_FALSE(sites.offered[0].sampled);
  EXPECT_TRUE(sites.offered[1].sampled);
  EXPECT_EQ(sites.offered[1].cell, (Cell{4, 1}));
}

// Of a lattice half a cell off that of the map, the middle of each square lies on the edge of a
// cell whose own middle is on the edge of the next square.
TEST(FindSites, ASiteIsSampledByAReadingWhereItsRobotStopsHoweverTheLatticeLies) {
  for (const double shift_m : {0.05, 0.03, -0.02, 0.08}) {
    for (const double spacing_m : {0.05, 0.1, 0.15}) {
      SiteCase c(testing::OpenArt(12, 12, {6, 6}));
      c.options.sites.spacing_m = spacing_m;
      c.options.sites.region =
          Rectangle{{0.3 + shift_m, 0.3 + shift_m},
                    {0.3 + shift_m + 4 * spacing_m, 0.3 + shift_m + 4 * spacing_m}};
      const std::size_t count = c.Find().offered.size();
      for (std::size_t i = 0; i < count; ++i) {
        const Site site = c.Find().offered.at(i);
        testing::SetSampled(c.belief, {c.belief.geometry().CellAt(site.place)});
        EXPECT_TRUE(c.Find().offered.at(i).sampled) << shift_m << " " << spacing_m << " " << i;
        EXPECT_TRUE(AreSampled(c.belief, c.Lattice(), {site.place}));
      }
    }
  }
}

TEST(FindSites, OffersEachCellOnceThoughSitesLieCloser) {
  SiteCase c(testing::OpenArt(4, 4));
  c.options.sites.spacing_m = 0.05;
  const Sites sites = c.Find();
  std::set<std::size_t> cells;
  for (const Site& site : sites.offered) cells.insert(c.belief.geometry().Index(site.cell));
  EXPECT_EQ(cells.size(), 16u);
  EXPECT_THAT(sites.offered, SizeIs(16));
}

TEST(FindSites, KeepsToTheRegion) {
  SiteCase c(testing::OpenArt(8, 8));
  c.options.sites.region = Rectangle{{0.2, 0.3}, {0.5, 0.5}};
  const Sites sites = c.Find();
  ASSERT_THAT(sites.offered, SizeIs(6));
  EXPECT_EQ(sites.offered.front().cell, (Cell{2, 3}));
  EXPECT_EQ(sites.offered.back().cell, (Cell{4, 4}));
}

TEST(FindSites, OfARegionOffTheMapAreNone) {
  SiteCase c(testing::OpenArt(4, 4));
  c.options.sites.region = Rectangle{{100.0, 100.0}, {101.0, 101.0}};
  EXPECT_THAT(c.Find().offered, IsEmpty());
}

TEST(FindSites, RejectsWhatIsSetAside) {
  SiteCase c(testing::OpenArt(9, 1));
  const Point2 place = c.At({6, 0});
  c.belief.set_aside.push_back(
      {{GoalKind::kSite, {6, 0}, place, place, 0}, "reported blocked", 1'000'000'000});
  const Sites sites = c.Find();
  // Nearer than kSamePlaceRadius_m are its neighbours too.
  ASSERT_THAT(sites.rejected, SizeIs(3));
  EXPECT_EQ(sites.rejected[1].reason, RejectionReason::kSetAside);
  EXPECT_EQ(sites.rejected[1].goal.cell, (Cell{6, 0}));
  EXPECT_EQ(SiteIn(sites, {6, 0}), nullptr);
}

TEST(FindSites, RejectsAllStopsOfAnotherRobotsLivePlan) {
  SiteCase c(testing::OpenArt(30, 1));
  testing::AddOtherRobot(c.belief, "other", {c.At({8, 0}), c.At({20, 0})});
  const Sites sites = c.Find();
  EXPECT_EQ(SiteIn(sites, {8, 0}), nullptr) << "where it stops on its way";
  EXPECT_NE(SiteIn(sites, {9, 0}), nullptr) << "where it passes";
  EXPECT_EQ(SiteIn(sites, {20, 0}), nullptr) << "its goal";
  ASSERT_FALSE(sites.rejected.empty());
  for (const RejectedGoal& rejected : sites.rejected) {
    EXPECT_EQ(rejected.reason, RejectionReason::kClaimed);
    EXPECT_EQ(rejected.detail, "by robot \"other\"");
  }
}

TEST(FindSites, OwnStopsAndThoseOfAClaimThatRanOutAreOffered) {
  SiteCase c(testing::OpenArt(30, 1));
  testing::AddOtherRobot(c.belief, "other", {c.At({8, 0}), c.At({20, 0})}, 5);
  c.belief.sample_time_ns = 6;
  EXPECT_THAT(c.Find().offered, SizeIs(30)) << "a robot that is stuck keeps nobody away";
  testing::AddOtherRobot(c.belief, "r", {c.At({8, 0}), c.At({20, 0})});
  EXPECT_THAT(c.Find().offered, SizeIs(30));
}

TEST(AreSampled, IsOfAllPlacesInsideTheRegionAndOut) {
  SiteCase c(testing::OpenArt(6, 1));
  c.options.sites.region = Rectangle{{0.0, 0.0}, {0.4, 0.1}};
  testing::SetSampled(c.belief, {{1, 0}, {5, 0}});
  EXPECT_TRUE(AreSampled(c.belief, c.Lattice(), {c.At({1, 0})}));
  EXPECT_FALSE(AreSampled(c.belief, c.Lattice(), {c.At({1, 0}), c.At({2, 0})}));
  EXPECT_TRUE(AreSampled(c.belief, c.Lattice(), {c.At({5, 0})}));
  EXPECT_FALSE(AreSampled(c.belief, c.Lattice(), {{-7.0, 0.0}}));
}

}  // namespace sites_test
}  // namespace plumescout
