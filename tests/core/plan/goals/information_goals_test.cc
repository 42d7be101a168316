// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/information_goals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/frontier/gas_frontier.h"
#include "core/grid/grid_search.h"
#include "core/types/rng.h"
#include "tests/support/goal_case.h"

namespace plumescout {
namespace information_goals_test {

using ::testing::Contains;
using testing::GoalCase;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const float kUnknown = std::numeric_limits<float>::quiet_NaN();

// A hall of 8 m x 6 m with two walls in it, and the robot in its south-west.
testing::GridArt HallArt() {
  constexpr int kHeight = 60;
  testing::GridArt art(kHeight, "#" + std::string(78, '.') + "#");
  art.front() = art.back() = std::string(80, '#');
  for (int row = 0; row < 40; ++row) art[static_cast<std::size_t>(row)][30] = '#';
  for (int row = 15; row < kHeight; ++row) art[static_cast<std::size_t>(row)][55] = '#';
  art[50][5] = 'S';
  return art;
}

// Gas fields by a function of the cell; NaN off free cells.
template <typename Of>
void SetGas(GoalCase& c, const Of& mean_and_variance) {
  Grid<float> mean(c.belief.geometry(), kUnknown);
  Grid<float> variance = mean;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if ((*c.belief.occupancy)[i] != CellState::kFree) continue;
    std::tie(mean[i], variance[i]) = mean_and_variance(mean.geometry().CellAtIndex(i));
  }
  c.belief.gas_mean_ppm = std::make_shared<const Grid<float>>(mean);
  c.belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(variance);
}

float OpenVariance_ppm2() {
  return static_cast<float>(OpenLatticeVariance_ppm2(MissionOptions().gas));
}

// Everywhere the same gas, known to a share of the prior's variance.
GoalCase Hall(float mean_ppm, float variance_share) {
  GoalCase c(HallArt());
  c.belief.gas_counters.readings = 1;
  SetGas(c, [&](Cell) { return std::pair(mean_ppm, variance_share * OpenVariance_ppm2()); });
  return c;
}

GoalCase RandomHall(std::uint64_t seed) {
  GoalCase c = Hall(0.0F, 1.0F);
  Rng rng(seed);
  SetGas(c, [&](Cell) {
    const auto mean_ppm = static_cast<float>(rng.Uniform(-2.0, 12.0));
    const auto share = static_cast<float>(rng.Uniform(0.1, 1.5));
    return std::pair(mean_ppm, rng.Below(20) == 0 ? kUnknown : share * OpenVariance_ppm2());
  });
  return c;
}

std::vector<Goal> Find(const GoalCase& c, std::vector<RejectedGoal>& rejected) {
  return InformationGoals(c.Query(), rejected);
}
std::vector<Goal> Find(const GoalCase& c) {
  std::vector<RejectedGoal> rejected;
  return Find(c, rejected);
}

TEST(InformationGoals, AreNoneBeforeTheFirstReading) {
  GoalCase c = Hall(10.0F, 1.0F);
  EXPECT_THAT(Find(c), SizeIs(12));
  c.belief.gas_counters.readings = 0;
  EXPECT_THAT(Find(c), IsEmpty());
}

TEST(InformationGoals, AreReachableApartFromEachOtherAndAReadingAway) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const GoalCase c = RandomHall(seed);
    const std::vector<Goal> goals = Find(c);
    ASSERT_THAT(goals, SizeIs(12));
    const Grid<double> travel_m = TravelDistances_m(c.reachable, std::vector<Cell>{c.start});
    for (std::size_t i = 0; i < goals.size(); ++i) {
      EXPECT_EQ(goals[i].kind, GoalKind::kInformation);
      EXPECT_EQ(goals[i].position, c.belief.geometry().Center(goals[i].cell));
      EXPECT_EQ(goals[i].centroid, goals[i].position);
      EXPECT_NE(c.reachable[goals[i].cell], 0);
      EXPECT_GE(travel_m[goals[i].cell], 1.25 / 2.0) << "speed over rate";
      for (std::size_t k = 0; k < i; ++k) {
        EXPECT_GE(Distance_m(goals[i].position, goals[k].position), 1.5);
      }
    }
  }
}

TEST(InformationGoals, KeepTheLeastDistanceOfGoals) {
  GoalCase c = Hall(10.0F, 1.0F);
  c.options.min_goal_distance_m = 3.0;
  const Grid<double> travel_m = TravelDistances_m(c.reachable, std::vector<Cell>{c.start});
  const std::vector<Goal> goals = Find(c);
  EXPECT_FALSE(goals.empty());
  for (const Goal& goal : goals) EXPECT_GE(travel_m[goal.cell], 3.0);
  c.options.min_goal_distance_m = 0.0;
  c.options.reading_rate_hz = 0.01;
  EXPECT_THAT(Find(c), IsEmpty()) << "no way is long enough for a reading";
}

// What the header says of a cell, in double precision and cell by cell.
double SlowLeft(const GoalCase& c, Cell cell, double greatest_ppm) {
  const double eps_inf = static_cast<double>(OpenVariance_ppm2());
  const double variance = static_cast<double>((*c.belief.gas_variance_ppm2)[cell]);
  if (std::isnan(variance)) return 0.0;
  const double gas = std::max(0.0, static_cast<double>((*c.belief.gas_mean_ppm)[cell]));
  const double relevance =
      0.05 + 0.95 * std::pow(std::min(1.0, gas / 4.0), 2) + 0.5 * gas / greatest_ppm;
  const double done = 0.7 * eps_inf * (1.0 - 0.5 * std::min(1.0, relevance));
  return relevance * std::max(0.0, 0.5 * std::log(std::min(variance, eps_inf) / done));
}

// Merit by cell; none where no goal may be.
std::vector<double> SlowMerits(const GoalCase& c) {
  const GridGeometry& geometry = c.belief.geometry();
  double greatest_ppm = 4.0;
  for (const float mean : c.belief.gas_mean_ppm->values()) {
    if (!std::isnan(mean)) greatest_ppm = std::max(greatest_ppm, static_cast<double>(mean));
  }
  const Grid<double> travel_m = TravelDistances_m(c.reachable, std::vector<Cell>{c.start});
  std::vector<double> merits(geometry.size(), 0.0);
  for (std::size_t i = 0; i < merits.size(); ++i) {
    const Cell cell = geometry.CellAtIndex(i);
    const bool may_be = c.reachable[i] != 0 && travel_m[i] >= 0.625;
    if (!may_be || SlowLeft(c, cell, greatest_ppm) <= 0.0) continue;
    double sum = 0.0;
    for (int y = cell.y - 5; y <= cell.y + 5; ++y) {
      for (int x = cell.x - 5; x <= cell.x + 5; ++x) {
        if (geometry.Contains({x, y})) sum += SlowLeft(c, {x, y}, greatest_ppm);
      }
    }
    merits[i] = sum / (4.0 + travel_m[i]);
  }
  return merits;
}

TEST(InformationGoals, AreTheBestThatAreNotTooNearToBetterOnes) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const GoalCase c = RandomHall(seed);
    const GridGeometry& geometry = c.belief.geometry();
    std::vector<double> merits = SlowMerits(c);
    for (const Goal& goal : Find(c)) {
      const double best = *std::max_element(merits.begin(), merits.end());
      // The sums of 121 values are rounded to single precision.
      EXPECT_NEAR(merits[geometry.Index(goal.cell)], best, 1e-5 * best) << "seed " << seed;
      for (std::size_t i = 0; i < merits.size(); ++i) {
        const Point2 place = geometry.Center(geometry.CellAtIndex(i));
        if (Distance_m(place, goal.position) < 1.5) merits[i] = 0.0;
      }
    }
  }
}

TEST(InformationGoals, EndWhereTheGasIsKnownWell) {
  EXPECT_THAT(Find(Hall(10.0F, 0.34F)), IsEmpty());
  EXPECT_THAT(Find(Hall(10.0F, 0.36F)), SizeIs(12));
}

TEST(InformationGoals, EndSoonerWhereTheAirIsClean) {
  EXPECT_THAT(Find(Hall(0.0F, 0.68F)), IsEmpty());  // relevance 0.05: done at 0.6825
  EXPECT_THAT(Find(Hall(0.0F, 0.69F)), SizeIs(12));
}

TEST(InformationGoals, AreNoneForTheSakeOfCellsThatNobodyCanReadIn) {
  testing::GridArt art = HallArt();
  // A closed chamber in the middle of the hall.
  for (std::size_t row = 25; row <= 32; ++row) {
    for (std::size_t column = 40; column <= 47; ++column) art[row][column] = 'i';
  }
  GoalCase c(art);
  c.belief.gas_counters.readings = 1;
  const auto set = [&](float around) {
    SetGas(c, [&](Cell cell) {
      const bool chamber = testing::ArtAt(art, cell) == 'i';
      return std::pair(10.0F, (chamber ? 1.0F : around) * OpenVariance_ppm2());
    });
  };
  set(0.1F);
  EXPECT_THAT(Find(c), IsEmpty());
  set(0.5F);
  EXPECT_FALSE(Find(c).empty());
}

TEST(InformationGoals, AreNoneWithoutAField) {
  GoalCase c = Hall(10.0F, 1.0F);
  SetGas(c, [](Cell) { return std::pair(kUnknown, kUnknown); });
  EXPECT_THAT(Find(c), IsEmpty());
  SetGas(c, [](Cell) { return std::pair(kUnknown, 10.0F); });
  EXPECT_FALSE(Find(c).empty()) << "a variance without a mean is that of clean air";
}

TEST(InformationGoals, TakeAnInfiniteVarianceForThatOfThePrior) {
  GoalCase c = Hall(10.0F, 1.0F);
  const std::vector<Goal> prior = Find(c);
  SetGas(c, [](Cell) { return std::pair(10.0F, std::numeric_limits<float>::infinity()); });
  const std::vector<Goal> infinite = Find(c);
  ASSERT_EQ(infinite.size(), prior.size());
  for (std::size_t i = 0; i < prior.size(); ++i) EXPECT_EQ(infinite[i].cell, prior[i].cell);
}

TEST(InformationGoals, OfTwoRobotsAreApart) {
  GoalCase c = RandomHall(3);
  const std::vector<Goal> goals = Find(c);
  c.belief.claims = {{"other", 1, goals[0], 1000}};
  std::vector<RejectedGoal> rejected;
  const std::vector<Goal> others = Find(c, rejected);
  EXPECT_FALSE(others.empty());
  for (const Goal& goal : others) {
    EXPECT_FALSE(ClaimCovers(goals[0], goal));
    EXPECT_GE(Distance_m(goals[0].position, goal.position), 1.5);
  }
  ASSERT_THAT(rejected, SizeIs(1));
  EXPECT_EQ(rejected[0].reason, RejectionReason::kClaimed);
  EXPECT_EQ(rejected[0].goal.cell, goals[0].cell);
  c.belief.claims = {{"r", 1, goals[0], 1000}};
  EXPECT_EQ(Find(c)[0].cell, goals[0].cell) << "its own claim";
}

// A place where a robot may have driven to read, not only one that would be offered.
Goal PlaceForReadings(const GoalCase& c, Rng& rng) {
  const GridGeometry& geometry = c.belief.geometry();
  Goal goal;
  goal.kind = GoalKind::kInformation;
  do {
    goal.cell = geometry.CellAtIndex(rng.Below(geometry.size()));
  } while (c.reachable[goal.cell] == 0);
  goal.position = geometry.Center(goal.cell);
  goal.centroid = goal.position;
  return goal;
}

TEST(InformationGoals, KeepTheirDistanceFromEveryPlaceThatIsClaimedOrSetAside) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    GoalCase c = RandomHall(seed);
    Rng rng(1000 + seed);
    std::vector<Point2> taken;
    for (PlanId plan = 1; plan <= 3; ++plan) {
      const Goal claimed = PlaceForReadings(c, rng);
      c.belief.claims.push_back({absl::StrCat("other-", plan), plan, claimed, 1000});
      taken.push_back(claimed.position);
    }
    const Goal aside = PlaceForReadings(c, rng);
    c.belief.set_aside = {{aside, "visited without change", 1000}};
    taken.push_back(aside.position);
    std::vector<RejectedGoal> rejected;
    const std::vector<Goal> goals = Find(c, rejected);
    EXPECT_FALSE(goals.empty());
    for (const Goal& goal : goals) {
      for (const Point2 place : taken) {
        EXPECT_GE(Distance_m(place, goal.position), 1.5) << "seed " << seed;
      }
    }
    for (const RejectedGoal& rejection : rejected) {
      EXPECT_THAT(taken, Contains(rejection.goal.position)) << "seed " << seed;
    }
    c.belief.sample_time_ns = 1000;
    const std::vector<Goal> after = Find(c, rejected);
    const std::vector<Goal> alone = Find(RandomHall(seed));
    ASSERT_EQ(after.size(), alone.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_EQ(after[i].cell, alone[i].cell) << "claims and memory have expired";
    }
  }
}

TEST(InformationGoals, AreTheBestOfWhatClaimsLeave) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    GoalCase c = RandomHall(seed);
    Rng rng(2000 + seed);
    const Goal claimed = PlaceForReadings(c, rng);
    c.belief.claims = {{"other", 1, claimed, 1000}};
    const GridGeometry& geometry = c.belief.geometry();
    std::vector<double> merits = SlowMerits(c);
    const auto clear = [&](Point2 place) {
      for (std::size_t i = 0; i < merits.size(); ++i) {
        const Point2 other = geometry.Center(geometry.CellAtIndex(i));
        if (Distance_m(place, other) < 1.5) merits[i] = 0.0;
      }
    };
    clear(claimed.position);
    for (const Goal& goal : Find(c)) {
      const double best = *std::max_element(merits.begin(), merits.end());
      EXPECT_NEAR(merits[geometry.Index(goal.cell)], best, 1e-5 * best) << "seed " << seed;
      clear(goal.position);
    }
  }
}

TEST(InformationGoals, KeepApartFromClaimsOfAnyKindAndFromWhatIsSetAsideOfTheirs) {
  GoalCase c = RandomHall(5);
  const std::vector<Goal> alone = Find(c);
  Goal frontier = alone[0];
  frontier.kind = GoalKind::kOccupancyFrontier;
  c.belief.set_aside = {{frontier, "visited without change", 1000}};
  std::vector<RejectedGoal> rejected;
  EXPECT_EQ(Find(c, rejected)[0].cell, alone[0].cell);
  EXPECT_THAT(rejected, IsEmpty());
  c.belief.set_aside.clear();
  c.belief.claims = {{"other", 1, frontier, 1000}};
  for (const Goal& goal : Find(c, rejected)) {
    EXPECT_GE(Distance_m(goal.position, frontier.position), 1.5);
  }
  ASSERT_EQ(rejected.size(), 1U);
  EXPECT_EQ(rejected[0].reason, RejectionReason::kClaimed);
  c.belief.claims[0].goal.kind = GoalKind::kRandomFreeSpace;
  EXPECT_EQ(Find(c)[0].cell, alone[0].cell) << "who drives about at random";
}

TEST(InformationGoals, RejectPlacesOnlyIfSomethingIsLeftToTellAround) {
  GoalCase c = Hall(10.0F, 0.1F);
  Rng rng(1);
  c.belief.claims = {{"other", 1, PlaceForReadings(c, rng), 1000}};
  std::vector<RejectedGoal> rejected;
  EXPECT_THAT(Find(c, rejected), IsEmpty());
  EXPECT_THAT(rejected, IsEmpty());
}

TEST(InformationGoals, AreNotWhereVisitsBroughtNothing) {
  GoalCase c = RandomHall(4);
  const Goal best = Find(c)[0];
  c.belief.set_aside = {{best, "visited without change", 1000}};
  std::vector<RejectedGoal> rejected;
  for (const Goal& goal : Find(c, rejected)) EXPECT_FALSE(SamePlace(best, goal));
  ASSERT_THAT(rejected, SizeIs(1));
  EXPECT_EQ(rejected[0].reason, RejectionReason::kSetAside);
  c.belief.sample_time_ns = 1000;
  EXPECT_EQ(Find(c)[0].cell, best.cell) << "it has expired";
}

TEST(InformationGoals, AreTheSameAgain) {
  const std::vector<Goal> once = Find(RandomHall(6));
  const std::vector<Goal> again = Find(RandomHall(6));
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].cell, again[i].cell);
}

}  // namespace information_goals_test
}  // namespace plumescout
