// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "core/plan/sampling/ways.h"
#include "tests/support/site_case.h"

namespace plumescout {
namespace survey_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::SiteCase;
using ::testing::SizeIs;

constexpr double kRounding = 1e-9;

SiteCase Yard(int width, int height, int stride, Cell start = {0, 0}) {
  SiteCase c(testing::OpenArt(width, height, start));
  c.options.sites.survey = true;
  c.options.sites.survey_stride = stride;
  return c;
}

std::vector<Site> Rest(const SiteCase& c) {
  const Sites sites = c.Find();
  const GoalQuery robot = c.Query();
  const StopFn never = NeverStop();
  const auto rest = RestOfSurvey({robot, c.At(c.start), sites, 1, never});
  EXPECT_TRUE(rest.ok()) << rest.status();
  return rest.ok() ? *rest : std::vector<Site>{};
}

// From the robot through all stops, with ways round obstacles.
double Drive_m(const SiteCase& c, const std::vector<Site>& stops) {
  double length_m = 0.0;
  Point2 at = c.At(c.start);
  for (const Site& stop : stops) {
    length_m += WaysFrom(c.reachable, at, {stop.place}).at(0).length_m;
    at = stop.place;
  }
  return length_m;
}

TEST(CheckSurvey, WantsTheLastRowAndColumnAmongItsSites) {
  EXPECT_TRUE(CheckSurvey({{0, 0}, 1.0, 51, 51}, 10).ok());
  EXPECT_TRUE(CheckSurvey({{0, 0}, 1.0, 1, 21}, 10).ok());
  EXPECT_TRUE(CheckSurvey({{0, 0}, 1.0, 8, 8}, 1).ok());
  for (const SiteLattice& lattice :
       {SiteLattice{{0, 0}, 1.0, 50, 51}, SiteLattice{{0, 0}, 1.0, 51, 52}}) {
    const absl::Status status = CheckSurvey(lattice, 10);
    EXPECT_TRUE(absl::IsInvalidArgument(status));
    EXPECT_THAT(std::string(status.message()), HasSubstr("planning.sites.survey_stride = 10"));
  }
}

TEST(CheckSurvey, LimitsWhatTheIntegerProgramHasToSolve) {
  EXPECT_THAT(std::string(CheckSurvey({{0, 0}, 1.0, 13, 12}, 1).message()),
              HasSubstr("13 x 12 sites; must be at most 64"));
  EXPECT_TRUE(absl::IsInvalidArgument(CheckSurvey({{0, 0}, 1.0, 1000, 1000}, 1)));
}

// [LHR] section IV-A: 350 m, which are 35 legs of 10 m between 36 sites. Here cells of 0.1 m.
TEST(RestOfSurvey, IsThatOfThePaper) {
  const SiteCase c = Yard(51, 51, 10);
  const std::vector<Site> stops = Rest(c);
  ASSERT_THAT(stops, SizeIs(36));
  std::set<std::size_t> sites;
  for (const Site& stop : stops) {
    EXPECT_EQ(stop.cell.x % 10, 0);
    EXPECT_EQ(stop.cell.y % 10, 0);
    sites.insert(stop.index);
  }
  EXPECT_THAT(sites, SizeIs(36)) << "each once";
  EXPECT_EQ(stops.front().cell, (Cell{0, 0})) << "where the robot stands";
  for (std::size_t i = 1; i < stops.size(); ++i) {
    EXPECT_NEAR(Distance_m(stops[i - 1].place, stops[i].place), 1.0, kRounding);
  }
  EXPECT_NEAR(Drive_m(c, stops), 35.0, kRounding);
}

TEST(RestOfSurvey, BeginsAtTheSiteNearestToTheRobot) {
  for (const Cell corner : {Cell{50, 0}, Cell{0, 50}, Cell{50, 50}}) {
    EXPECT_EQ(Rest(Yard(51, 51, 10, corner)).front().cell, corner);
  }
  EXPECT_EQ(Rest(Yard(51, 51, 10, {22, 29})).front().cell, (Cell{20, 30}));
}

TEST(RestOfSurvey, GoesOnWhereItWasBrokenOff) {
  SiteCase c = Yard(51, 51, 10);
  const std::vector<Site> all = Rest(c);
  for (const std::size_t done : {5u, 12u, 18u, 30u, 35u}) {
    std::vector<Cell> sampled;
    for (std::size_t i = 0; i < done; ++i) sampled.push_back(all[i].cell);
    SiteCase later = Yard(51, 51, 10, all[done - 1].cell);
    testing::SetSampled(later.belief, sampled);
    const std::vector<Site> rest = Rest(later);
    ASSERT_THAT(rest, SizeIs(36 - done));
    EXPECT_NEAR(Drive_m(later, rest), static_cast<double>(36 - done), kRounding)
        << "legs of 1 m, after " << done;
  }
}

TEST(RestOfSurvey, IsNothingOnceAllOfItsSitesAreSampled) {
  SiteCase c = Yard(3, 3, 2);
  testing::SetSampled(c.belief, {{0, 0}, {2, 0}, {0, 2}, {2, 2}});
  EXPECT_THAT(Rest(c), IsEmpty());
}

TEST(RestOfSurvey, OfOneSiteAndOfTwoIsDrivenToo) {
  EXPECT_THAT(Rest(Yard(1, 1, 1)), SizeIs(1));
  const SiteCase c = Yard(3, 1, 2);
  EXPECT_NEAR(Drive_m(c, Rest(c)), 0.2, kRounding);
}

TEST(RestOfSurvey, InARowIsATourThoughTheMeshHasNone) {
  const SiteCase c = Yard(9, 1, 2, {4, 0});
  const std::vector<Site> stops = Rest(c);
  EXPECT_THAT(stops, SizeIs(5));
  EXPECT_NEAR(Drive_m(c, stops), 1.2, kRounding) << "to the one end, then to the other";
}

TEST(RestOfSurvey, LeavesOutSitesInObstaclesAndDrivesRoundThem) {
  const testing::GridArt art = {".....",  //
                                ".....",  //
                                "..#..",  //
                                ".###.",  //
                                "S...."};
  SiteCase c(art);
  c.options.sites.survey = true;
  c.options.sites.survey_stride = 2;
  const std::vector<Site> stops = Rest(c);
  ASSERT_THAT(stops, SizeIs(8)) << "all but the middle";
  Point2 at = c.At(c.start);
  for (const Site& stop : stops) {
    const Way way = WaysFrom(c.reachable, at, {stop.place}).at(0);
    EXPECT_FALSE(way.vertices.empty());
    at = stop.place;
  }
  EXPECT_NEAR(Drive_m(c, stops), 7 * 0.2, kRounding) << "round the middle, and not back";
}

TEST(RestOfSurvey, LeavesOutSitesThatCannotBeReached) {
  const testing::GridArt art = {"..#..",  //
                                "..#..",  //
                                "..#..",  //
                                "..#..",  //
                                "S.#.."};
  SiteCase c(art);
  c.options.sites.survey = true;
  c.options.sites.survey_stride = 2;
  EXPECT_THAT(Rest(c), SizeIs(3));
}

TEST(RestOfSurvey, SaysWhenItIsStopped) {
  const SiteCase c = Yard(51, 51, 10);
  const Sites sites = c.Find();
  const GoalQuery robot = c.Query();
  const StopFn always = [] { return true; };
  EXPECT_TRUE(
      absl::IsDeadlineExceeded(RestOfSurvey({robot, c.At(c.start), sites, 1, always}).status()));
}

}  // namespace survey_test
}  // namespace plumescout
