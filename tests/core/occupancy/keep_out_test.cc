// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/keep_out.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "core/types/rng.h"

namespace plumescout {
namespace keep_out_test {

constexpr GridGeometry kGeometry = {-1.0, -0.5, 0.1, 30, 20};

Polygon Box(double x0_m, double y0_m, double x1_m, double y1_m) {
  return {{{x0_m, y0_m}, {x1_m, y0_m}, {x1_m, y1_m}, {x0_m, y1_m}}};
}

int Count(const Grid<std::uint8_t>& cells) {
  int count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) count += cells[i];
  return count;
}

// How often the boundary winds round the point, by the sum of the angles it turns through; its
// parity is the even-odd rule.
bool HoldsByWinding(const Polygon& area, Point2 p) {
  double angle_rad = 0.0;
  for (std::size_t i = 0; i < area.vertices.size(); ++i) {
    const Point2 a = area.vertices[i];
    const Point2 b = area.vertices[(i + 1) % area.vertices.size()];
    angle_rad += WrapAngle_rad(std::atan2(b.y_m - p.y_m, b.x_m - p.x_m) -
                               std::atan2(a.y_m - p.y_m, a.x_m - p.x_m));
  }
  return std::lround(angle_rad / (2.0 * M_PI)) % 2 != 0;
}

TEST(KeptOutCells, AreThoseWhoseCentreLiesInAnArea) {
  Rng rng(4);
  for (int trial = 0; trial < 200; ++trial) {
    Polygon area;
    const std::uint64_t vertices = 3 + rng.Below(6);
    for (std::uint64_t i = 0; i < vertices; ++i) {
      area.vertices.push_back({rng.Uniform(-1.5, 2.5), rng.Uniform(-1.0, 2.0)});
    }
    const Grid<std::uint8_t> cells = KeptOutCells({area}, kGeometry);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Point2 centre = kGeometry.Center(kGeometry.CellAtIndex(i));
      ASSERT_EQ(cells[i] != 0, HoldsByWinding(area, centre)) << trial;
    }
  }
}

TEST(KeptOutCells, OfAnAreaOnCellEdgesAreTheCellsWithin) {
  EXPECT_EQ(Count(KeptOutCells({Box(0.0, 0.0, 0.3, 0.2)}, kGeometry)), 6);
}

TEST(KeptOutCells, OfAreasSideBySideOverlapNowhereAndLeaveNoGap) {
  // The common side runs through centres of cells.
  EXPECT_EQ(Count(KeptOutCells({Box(0.0, 0.0, 0.25, 0.3)}, kGeometry)) +
                Count(KeptOutCells({Box(0.25, 0.0, 0.5, 0.3)}, kGeometry)),
            15);
}

TEST(KeptOutCells, OfSeveralAreasAreTheirUnion) {
  EXPECT_EQ(Count(KeptOutCells({Box(0, 0, 0.2, 0.2), Box(0.1, 0.1, 0.3, 0.3)}, kGeometry)), 7);
}

TEST(KeptOutCells, MayBeAllOrNoneOfTheMap) {
  EXPECT_EQ(Count(KeptOutCells({Box(-1e6, -1e6, 1e6, 1e6)}, kGeometry)), 600);
  EXPECT_EQ(Count(KeptOutCells({Box(50, 50, 51, 51)}, kGeometry)), 0);
  EXPECT_EQ(Count(KeptOutCells({{{{0, 0}, {1, 1}, {0, 0}}}}, kGeometry)), 0) << "of no area";
  EXPECT_EQ(KeptOutCells({Box(0, 0, 1, 1)}, GridGeometry{}).size(), 0u);
}

TEST(CloseKeptOut, ClosesCellsAndOpensNone) {
  Grid<std::uint8_t> traversable(kGeometry, 1);
  traversable[Cell{0, 0}] = 0;
  CloseKeptOut({Box(0.0, 0.0, 0.3, 0.2)}, traversable);
  EXPECT_EQ(Count(traversable), 600 - 1 - 6);
  EXPECT_EQ(traversable[kGeometry.CellAt({0.15, 0.15})], 0);
}

TEST(IsKeptOut, AgreesWithTheCells) {
  Rng rng(5);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Polygon> areas(2);
    for (Polygon& area : areas) {
      for (int i = 0; i < 5; ++i) {
        area.vertices.push_back({rng.Uniform(-1.5, 2.5), rng.Uniform(-1.0, 2.0)});
      }
    }
    const Grid<std::uint8_t> cells = KeptOutCells(areas, kGeometry);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Point2 centre = kGeometry.Center(kGeometry.CellAtIndex(i));
      ASSERT_EQ(IsKeptOut(areas, centre), cells[i] != 0) << trial;
    }
  }
  EXPECT_FALSE(IsKeptOut({}, {0.0, 0.0}));
}

// Columns 10 to 12 of row 5 to 6 are closed.
TEST(FirstKeptOut, IsWhereTheWayEntersAnAreaOrWhereItEndsInOne) {
  const Grid<std::uint8_t> closed = KeptOutCells({Box(0.0, 0.0, 0.3, 0.2)}, kGeometry);
  const auto at = [](int x) { return kGeometry.Center({x, 5}); };
  EXPECT_EQ(FirstKeptOut(closed, {at(5), at(20)}), (Cell{10, 5}));
  EXPECT_EQ(FirstKeptOut(closed, {at(20), at(15), at(5)}), (Cell{12, 5}));
  EXPECT_EQ(FirstKeptOut(closed, {at(11), at(20)}), std::nullopt) << "out of it";
  EXPECT_EQ(FirstKeptOut(closed, {at(11), at(20), at(5)}), (Cell{12, 5})) << "and in again";
  EXPECT_EQ(FirstKeptOut(closed, {at(11), at(10)}), (Cell{10, 5})) << "it stays there";
  EXPECT_EQ(FirstKeptOut(closed, {at(11)}), (Cell{11, 5}));
  EXPECT_EQ(FirstKeptOut(closed, {at(5), at(9)}), std::nullopt);
  EXPECT_EQ(FirstKeptOut(closed, {}), std::nullopt);
}

}  // namespace keep_out_test
}  // namespace plumescout
