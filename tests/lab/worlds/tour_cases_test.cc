// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/tour_cases.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumescout::lab {
namespace tour_cases_test {

TEST(TourCases, PlacesLieInTheRegionAndFollowTheSeed) {
  Rng rng(3);
  Rng same(3);
  const std::vector<Point2> places = RandomTourPlaces(40, rng);
  const std::vector<Point2> again = RandomTourPlaces(40, same);
  ASSERT_EQ(places.size(), 40u);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_GE(std::min(places[i].x_m, places[i].y_m), 0.0);
    EXPECT_LE(std::max(places[i].x_m, places[i].y_m), 50.0);
    EXPECT_EQ(places[i].x_m, again[i].x_m);
  }
}

TEST(TourCases, ASubsetCaseCanBeSolvedAsInThePaper) {
  Rng rng(1);
  const SubsetTourCase random = RandomSubsetTourCase(15, rng);
  ASSERT_EQ(random.between_m.size(), 15u * 15u);
  EXPECT_EQ(random.between_m[1], random.between_m[15]);
  const auto tour = BestSubsetTour(random.Problem());
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_EQ(tour->order.size(), 10u);
  EXPECT_LE(tour->feasible_subsets, 3003);  // 10 of 15
  EXPECT_GT(tour->feasible_subsets, 0);
}

}  // namespace tour_cases_test
}  // namespace plumescout::lab
