// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/ray.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/types/rng.h"

namespace plumescout {
namespace ray_test {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAreArray;

// Sums of a few hundred rounded lengths of order one cell.
constexpr double kTolerance_cells = 1e-9;

struct Crossing {
  Cell cell;
  double length_cells;
};

GridGeometry UnitGeometry() {
  GridGeometry geometry;
  geometry.resolution_m = 1.0;
  geometry.width = geometry.height = 10;
  return geometry;
}

GridGeometry OffsetGeometry() {
  GridGeometry geometry;
  geometry.origin_x_m = -6.4;
  geometry.origin_y_m = -12.8;
  geometry.resolution_m = 0.1;
  geometry.width = geometry.height = 128;
  return geometry;
}

std::vector<Crossing> Walk(const GridGeometry& geometry, Point2 from, Point2 to) {
  std::vector<Crossing> crossings;
  EXPECT_TRUE(WalkSegment(geometry, from, to, [&](Cell cell, double length_cells) {
    crossings.push_back({cell, length_cells});
    return true;
  }));
  return crossings;
}

std::vector<Cell> CellsOf(const std::vector<Crossing>& crossings) {
  std::vector<Cell> cells;
  for (const Crossing& crossing : crossings) cells.push_back(crossing.cell);
  return cells;
}

// Length of the segment inside the closed cell, by clipping (Liang and Barsky): the oracle.
double ClippedLength_cells(const GridGeometry& g, Point2 from, Point2 to, Cell cell) {
  const double delta[2] = {to.x_m - from.x_m, to.y_m - from.y_m};
  const double start[2] = {from.x_m, from.y_m};
  const double low[2] = {g.origin_x_m + cell.x * g.resolution_m,
                         g.origin_y_m + cell.y * g.resolution_m};
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double near = (low[axis] - start[axis]) / delta[axis];
    const double far = (low[axis] + g.resolution_m - start[axis]) / delta[axis];
    enter = std::max(enter, std::min(near, far));
    leave = std::min(leave, std::max(near, far));
  }
  return std::max(0.0, leave - enter) * std::hypot(delta[0], delta[1]) / g.resolution_m;
}

Point2 RandomPoint(Rng& rng) { return {rng.Uniform(-6.0, 6.0), rng.Uniform(-12.0, -1.0)}; }

TEST(WalkSegment, GivesEveryCellItsClippedLengthOnRandomSegments) {
  Rng rng(1);
  const GridGeometry geometry = OffsetGeometry();
  for (int trial = 0; trial < 500; ++trial) {
    const Point2 from = RandomPoint(rng);
    const Point2 to = RandomPoint(rng);
    double sum_cells = 0.0;
    for (const Crossing& crossing : Walk(geometry, from, to)) {
      ASSERT_NEAR(crossing.length_cells, ClippedLength_cells(geometry, from, to, crossing.cell),
                  kTolerance_cells);
      sum_cells += crossing.length_cells;
    }
    ASSERT_NEAR(sum_cells, Distance_m(from, to) / geometry.resolution_m, kTolerance_cells);
  }
}

TEST(WalkSegment, StepsToEdgeNeighboursAndNeverVisitsACellTwice) {
  Rng rng(2);
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<Cell> cells =
        CellsOf(Walk(OffsetGeometry(), RandomPoint(rng), RandomPoint(rng)));
    ASSERT_EQ(std::set<Cell>(cells.begin(), cells.end()).size(), cells.size());
    for (std::size_t i = 1; i < cells.size(); ++i) {
      ASSERT_EQ(std::abs(cells[i].x - cells[i - 1].x) + std::abs(cells[i].y - cells[i - 1].y), 1);
    }
  }
}

TEST(WalkSegment, VisitsTheSameCellsInBothDirections) {
  Rng rng(3);
  for (int trial = 0; trial < 500; ++trial) {
    const Point2 from = RandomPoint(rng);
    const Point2 to = RandomPoint(rng);
    ASSERT_THAT(CellsOf(Walk(OffsetGeometry(), to, from)),
                UnorderedElementsAreArray(CellsOf(Walk(OffsetGeometry(), from, to))));
  }
}

TEST(WalkSegment, VisitsTheSameCellsInBothDirectionsBetweenCentresOfCells) {
  Rng rng(4);
  const GridGeometry geometry = OffsetGeometry();
  for (int trial = 0; trial < 500; ++trial) {
    const Point2 from = geometry.Center(geometry.CellAtIndex(rng.Below(geometry.size())));
    const Point2 to = geometry.Center(geometry.CellAtIndex(rng.Below(geometry.size())));
    ASSERT_THAT(CellsOf(Walk(geometry, to, from)),
                UnorderedElementsAreArray(CellsOf(Walk(geometry, from, to))));
  }
}

TEST(WalkSegment, IsAdditiveUnderSubdivision) {
  Rng rng(5);
  const GridGeometry geometry = OffsetGeometry();
  // A field with a different value in every cell, summed along the way.
  const auto integral = [&](Point2 from, Point2 to) {
    double sum = 0.0;
    for (const Crossing& c : Walk(geometry, from, to)) {
      sum += (7.0 + c.cell.x % 5 + 3.0 * (c.cell.y % 7)) * c.length_cells;
    }
    return sum;
  };
  for (int trial = 0; trial < 200; ++trial) {
    const Point2 from = RandomPoint(rng);
    const Point2 to = RandomPoint(rng);
    const double share = rng.Uniform01();
    const Point2 middle = {from.x_m + share * (to.x_m - from.x_m),
                           from.y_m + share * (to.y_m - from.y_m)};
    // Values up to 29 per cell times rounding of the middle point, a few hundred cells.
    ASSERT_NEAR(integral(from, middle) + integral(middle, to), integral(from, to), 1e-7);
  }
}

TEST(WalkSegment, OfAPointVisitsItsCellWithLengthZero) {
  const std::vector<Crossing> crossings = Walk(UnitGeometry(), {3.5, 4.5}, {3.5, 4.5});
  ASSERT_EQ(crossings.size(), 1U);
  EXPECT_EQ(crossings[0].cell, (Cell{3, 4}));
  EXPECT_EQ(crossings[0].length_cells, 0.0);
}

TEST(WalkSegment, AlongAnEdgeStaysInTheCellsAboveIt) {
  EXPECT_THAT(CellsOf(Walk(UnitGeometry(), {1.5, 2.0}, {3.5, 2.0})),
              ElementsAre(Cell{1, 2}, Cell{2, 2}, Cell{3, 2}));
  EXPECT_THAT(CellsOf(Walk(UnitGeometry(), {2.0, 3.5}, {2.0, 1.5})),
              ElementsAre(Cell{2, 3}, Cell{2, 2}, Cell{2, 1}));
}

TEST(WalkSegment, ThroughACornerTouchesBothCellsBesideIt) {
  const std::vector<Crossing> crossings = Walk(UnitGeometry(), {0.5, 0.5}, {1.5, 1.5});
  EXPECT_THAT(CellsOf(crossings), ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{0, 1}, Cell{1, 1}));
  EXPECT_EQ(crossings[1].length_cells, 0.0);
  EXPECT_EQ(crossings[2].length_cells, 0.0);
}

TEST(WalkSegment, ThroughACornerTouchesBothCellsBesideItEastToWest) {
  EXPECT_THAT(CellsOf(Walk(UnitGeometry(), {1.5, 0.5}, {0.5, 1.5})),
              UnorderedElementsAreArray({Cell{1, 0}, Cell{0, 0}, Cell{1, 1}, Cell{0, 1}}));
}

TEST(WalkSegment, EndsInTheCellAboveAnEdgeOnWhichTheTargetLies) {
  EXPECT_THAT(CellsOf(Walk(UnitGeometry(), {0.5, 0.5}, {2.0, 0.5})),
              ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{2, 0}));
  EXPECT_THAT(CellsOf(Walk(UnitGeometry(), {2.5, 0.5}, {1.0, 0.5})),
              ElementsAre(Cell{2, 0}, Cell{1, 0}));
}

TEST(WalkSegment, ReachesTheCellOfATargetOnEveryEdgeOfARaster) {
  // 0.1 is no binary fraction: k * 0.1 lies a hair beside the edge of a cell.
  const GridGeometry geometry = OffsetGeometry();
  for (int k = 0; k <= geometry.width; ++k) {
    const Point2 to = {geometry.origin_x_m + k * 0.1, geometry.origin_y_m + 0.1 * (128 - k)};
    for (const Point2 from : {Point2{0.03, -7.7}, Point2{-6.4, -12.8}, to}) {
      ASSERT_EQ(Walk(geometry, from, to).back().cell, geometry.CellAt(to));
      ASSERT_EQ(Walk(geometry, to, from).back().cell, geometry.CellAt(from));
    }
  }
}

TEST(WalkSegment, StopsWhenAVisitSaysSo) {
  int visits = 0;
  EXPECT_FALSE(WalkSegment(UnitGeometry(), {0.5, 0.5}, {9.5, 3.5},
                           [&visits](Cell, double) { return ++visits < 3; }));
  EXPECT_EQ(visits, 3);
}

TEST(WalkSegment, LeavesTheRasterWhereTheSegmentDoes) {
  EXPECT_THAT(CellsOf(Walk(UnitGeometry(), {0.5, 0.5}, {-1.5, 0.5})),
              ElementsAre(Cell{0, 0}, Cell{-1, 0}, Cell{-2, 0}));
}

}  // namespace ray_test
}  // namespace plumescout
