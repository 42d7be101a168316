// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/site_lattice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace plumescout {
namespace site_lattice_test {

using ::testing::HasSubstr;

std::string Refusal(const Rectangle& region, double spacing_m) {
  const absl::Status status = MakeSiteLattice(region, spacing_m).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("planning.sites.region"));
  return std::string(status.message());
}

TEST(SiteLattice, HasASiteInTheMiddleOfEachSquareRowByRow) {
  const auto lattice = MakeSiteLattice({{-1.0, 2.0}, {5.0, 6.0}}, 2.0);
  ASSERT_TRUE(lattice.ok()) << lattice.status();
  EXPECT_EQ(lattice->columns, 3);
  EXPECT_EQ(lattice->rows, 2);
  ASSERT_EQ(lattice->size(), 6u);
  EXPECT_EQ(lattice->Place(0), (Point2{0.0, 3.0}));
  EXPECT_EQ(lattice->Place(2), (Point2{4.0, 3.0}));
  EXPECT_EQ(lattice->Place(3), (Point2{0.0, 5.0}));
}

TEST(SiteLattice, TakesWidthsThatAreWholeButForRounding) {
  const auto lattice = MakeSiteLattice({{0.1, 0.1}, {0.4, 0.8}}, 0.1);
  ASSERT_TRUE(lattice.ok()) << lattice.status();
  EXPECT_EQ(lattice->columns, 3);
  EXPECT_EQ(lattice->rows, 7);
}

TEST(SiteLattice, OfThePaperHas51SitesEachWay) {
  const auto lattice = MakeSiteLattice({{-0.5, -0.5}, {50.5, 50.5}}, 1.0);
  ASSERT_TRUE(lattice.ok()) << lattice.status();
  EXPECT_EQ(lattice->size(), 2601u);  // [LHR] Table II: a sweep of 2601 m
  EXPECT_EQ(lattice->Place(2600), (Point2{50.0, 50.0}));
}

TEST(SiteLattice, RefusesARegionThatIsNoMultipleOfTheSpacing) {
  EXPECT_THAT(Refusal({{0, 0}, {5.5, 4}}, 1.0), HasSubstr("5.5 m wide"));
  EXPECT_THAT(Refusal({{0, 0}, {5, 4.3}}, 1.0), HasSubstr("4.3 m high"));
  Refusal({{0, 0}, {0, 4}}, 1.0);
  Refusal({{0, 0}, {-5, 4}}, 1.0);
  Refusal({{0, 0}, {0.4, 4}}, 1.0);
}

TEST(SiteLattice, RefusesWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  Refusal({{nan, 0}, {5, 4}}, 1.0);
  Refusal({{0, 0}, {inf, 4}}, 1.0);
  Refusal({{0, 0}, {5, 4}}, nan);
  Refusal({{0, 0}, {5, 4}}, 0.0);
}

TEST(SiteLattice, HoldsAMillionSitesAndNoMore) {
  EXPECT_EQ(MakeSiteLattice({{0, 0}, {1000, 1000}}, 1.0)->size(), 1'000'000u);
  EXPECT_THAT(Refusal({{0, 0}, {1000, 1001}}, 1.0), HasSubstr("1000 x 1001 sites"));
  Refusal({{0, 0}, {1e6, 1e6}}, 0.05);
}

TEST(CoveringLattice, ReachesEveryCellOfTheMap) {
  const GridGeometry map{-1.3, 2.7, 0.1, 25, 9};
  const SiteLattice lattice = CoveringLattice(map, 1.0);
  EXPECT_EQ(lattice.corner, (Point2{-2.0, 2.0}));
  EXPECT_EQ(lattice.columns, 4);  // from -2 to 2, for the map ends at 1.2
  EXPECT_EQ(lattice.rows, 2);     // from 2 to 4, for it ends at 3.6
}

TEST(CoveringLattice, LeavesSitesWhereTheyAreWhileTheMapGrows) {
  const SiteLattice small = CoveringLattice({0.0, 0.0, 0.1, 20, 20}, 0.7);
  const SiteLattice grown = CoveringLattice({-3.2, -1.6, 0.1, 80, 80}, 0.7);
  // Corners lie on whole multiples of the spacing, so sites of both differ by such.
  for (const Point2 shift :
       {Point2{small.Place(0).x_m - grown.Place(0).x_m, small.Place(0).y_m - grown.Place(0).y_m}}) {
    EXPECT_NEAR(shift.x_m / 0.7, std::round(shift.x_m / 0.7), 1e-9);
    EXPECT_NEAR(shift.y_m / 0.7, std::round(shift.y_m / 0.7), 1e-9);
    EXPECT_GT(shift.x_m, 0.0);
  }
}

TEST(LatticeOver, IsOfTheRegionOrElseOfTheMap) {
  const GridGeometry map{0.0, 0.0, 0.1, 50, 40};
  SiteOptions options;
  EXPECT_EQ(LatticeOver(map, options).size(), 20u);
  options.region = Rectangle{{1.0, 1.0}, {3.0, 2.0}};
  EXPECT_EQ(LatticeOver(map, options).size(), 2u);
  EXPECT_EQ(LatticeOver(map, options).corner, (Point2{1.0, 1.0}));
}

TEST(SiteLattice, CoversABuildingWithTheSquaresOfASurvey) {
  // 7.3 m x 4 m from (-0.2, 1): squares from -1 to 8 and from 1 to 5; every third of 10 and of 4.
  const Rectangle region = RegionOver({-0.2, 1.0, 0.1, 73, 40}, 1.0, 3);
  EXPECT_EQ(region, (Rectangle{{-1.0, 1.0}, {9.0, 5.0}}));
}

}  // namespace site_lattice_test
}  // namespace plumescout
