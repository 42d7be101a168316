// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/subset_tour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/types/rng.h"

namespace plumescout {
namespace subset_tour_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kNoWay_m = std::numeric_limits<double>::infinity();

// A problem with what it looks at. 1 m/s and no sampling: the cycle in s is the limit in m.
struct Case {
  std::vector<double> from_start_m;
  std::vector<double> between_m;
  std::vector<double> rewards;
  int wanted = 1;
  double cycle_s = 1e6;
  double sampling_s = 0.0;
  double speed_mps = 1.0;

  std::size_t cells() const { return rewards.size(); }
  double Leg_m(int from, int to) const {
    return between_m[static_cast<std::size_t>(from) * cells() + static_cast<std::size_t>(to)];
  }
  SubsetTourProblem problem() const {
    return {from_start_m, between_m, rewards, wanted, cycle_s, sampling_s, speed_mps};
  }
  absl::StatusOr<SubsetTour> Solve() const { return BestSubsetTour(problem()); }
};

// Points on the x axis, the robot at 0.
Case OnALine(const std::vector<double>& x_m, const std::vector<double>& rewards, int wanted) {
  Case line{{}, {}, rewards, wanted};
  for (const double from_m : x_m) {
    line.from_start_m.push_back(std::abs(from_m));
    for (const double to_m : x_m) line.between_m.push_back(std::abs(from_m - to_m));
  }
  return line;
}

enum class Kind { kPlane, kAnyMatrix, kWholeNumbers };

// In the plane; or any symmetric matrix, without triangle inequality, some ways missing; or the
// same of few whole numbers, rewards too, where sums are exact and ties abound.
Case RandomCase(Kind kind, int cells, Rng& rng) {
  const auto random_m = [kind, &rng] {
    if (kind == Kind::kWholeNumbers) return static_cast<double>(rng.Below(4));
    return rng.Below(8) == 0 ? kNoWay_m : rng.Uniform(0.0, 50.0);
  };
  const auto n = static_cast<std::size_t>(cells);
  Case random{std::vector<double>(n), std::vector<double>(n * n), std::vector<double>(n)};
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double x_m = rng.Uniform(0.0, 50.0);
    points.emplace_back(x_m, rng.Uniform(0.0, 50.0));
    const bool plane = kind == Kind::kPlane;
    random.from_start_m[i] = plane ? std::hypot(x_m, points[i].second) : random_m();
    random.rewards[i] = kind == Kind::kWholeNumbers ? static_cast<double>(rng.Below(4)) - 1.0
                                                    : rng.Uniform(-1.0, 1.0);
    for (std::size_t j = 0; j < i; ++j) {
      const double between_m =
          plane ? std::hypot(x_m - points[j].first, points[i].second - points[j].second)
                : random_m();
      random.between_m[i * n + j] = random.between_m[j * n + i] = between_m;
    }
  }
  random.wanted = 1 + static_cast<int>(rng.Below(n));
  random.cycle_s = rng.Uniform(0.0, 200.0);
  if (kind == Kind::kWholeNumbers) random.cycle_s = 1.0 + static_cast<double>(rng.Below(10));
  return random;
}

double WayLength_m(const Case& c, const std::vector<int>& order) {
  double length_m = c.from_start_m[static_cast<std::size_t>(order[0])];
  for (std::size_t i = 1; i < order.size(); ++i) length_m += c.Leg_m(order[i - 1], order[i]);
  return length_m;
}

// First of the farthest cells.
int Farthest(const Case& c, const std::vector<int>& cells) {
  return *std::max_element(cells.begin(), cells.end(), [&c](int a, int b) {
    return c.from_start_m[static_cast<std::size_t>(a)] <
           c.from_start_m[static_cast<std::size_t>(b)];
  });
}

// Oracle: every order in which the farthest comes last.
double EveryOrder_m(const Case& c, std::vector<int> cells) {
  const int last = Farthest(c, cells);
  cells.erase(std::find(cells.begin(), cells.end(), last));
  double best_m = kNoWay_m;
  do {
    std::vector<int> order = cells;
    order.push_back(last);
    best_m = std::min(best_m, WayLength_m(c, order));
  } while (std::next_permutation(cells.begin(), cells.end()));
  return best_m;
}

// Oracle: depth-first search that gives up ways no shorter than the best one.
void Search(const Case& c, int last, std::vector<int>& order, std::vector<int>& open,
            double& best_m) {
  const double so_far_m = order.empty() ? 0.0 : WayLength_m(c, order);
  if (so_far_m >= best_m) return;
  if (open.empty()) {
    order.push_back(last);
    best_m = std::min(best_m, WayLength_m(c, order));
    order.pop_back();
    return;
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    const int next = open[i];
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
    order.push_back(next);
    Search(c, last, order, open, best_m);
    order.pop_back();
    open.insert(open.begin() + static_cast<std::ptrdiff_t>(i), next);
  }
}

double DepthFirst_m(const Case& c, std::vector<int> cells) {
  const int last = Farthest(c, cells);
  cells.erase(std::find(cells.begin(), cells.end(), last));
  std::vector<int> order;
  double best_m = kNoWay_m;
  Search(c, last, order, cells, best_m);
  return best_m;
}

struct Winner {
  unsigned subset = 0;
  double length_m = 0.0;
  double reward = 0.0;
  int feasible = 0;
};

// All subsets of the wanted size, then of one less, each priced by `price_m`. A length within
// rounding of the limit would make the comparison vacuous; random ones are not.
template <typename Price>
Winner Oracle(const Case& c, const Price& price_m) {
  Winner best;
  for (int size = c.wanted; size > 0 && best.feasible == 0; --size) {
    const double limit_m = (c.cycle_s - size * c.sampling_s) * c.speed_mps;
    for (unsigned subset = 1; subset < 1U << c.cells(); ++subset) {
      std::vector<int> cells;
      double reward = 0.0;
      for (int i = 0; i < static_cast<int>(c.cells()); ++i) {
        if ((subset >> i & 1U) == 0) continue;
        cells.push_back(i);
        reward += c.rewards[static_cast<std::size_t>(i)];
      }
      if (static_cast<int>(cells.size()) != size) continue;
      const double length_m = price_m(c, cells);
      if (std::isinf(length_m) || length_m > limit_m) continue;
      const bool wins = best.feasible == 0 || reward > best.reward ||
                        (reward == best.reward && length_m < best.length_m);
      if (wins) best = {subset, length_m, reward, best.feasible};
      ++best.feasible;
    }
  }
  return best;
}

// The tour is the oracle's: same cells, the length of its order, ending where it should.
void ExpectTour(const Case& c, const Winner& expected) {
  constexpr double kRounding = 1e-9;
  const absl::StatusOr<SubsetTour> tour = c.Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  unsigned subset = 0;
  for (const int cell : tour->order) subset |= 1U << cell;
  EXPECT_EQ(subset, expected.subset);
  EXPECT_EQ(tour->feasible_subsets, expected.feasible);
  EXPECT_NEAR(tour->reward, expected.reward, kRounding);
  EXPECT_NEAR(tour->length_m, expected.length_m, kRounding);
  if (tour->order.empty()) return;
  EXPECT_NEAR(tour->length_m, WayLength_m(c, tour->order), kRounding);
  std::vector<int> cells = tour->order;
  std::sort(cells.begin(), cells.end());
  EXPECT_EQ(tour->order.back(), Farthest(c, cells));
  EXPECT_EQ(std::unique(cells.begin(), cells.end()), cells.end());
}

TEST(SubsetTour, RandomCasesAreThoseOfEveryOrder) {
  Rng rng(1);
  for (const Kind kind : {Kind::kPlane, Kind::kAnyMatrix, Kind::kWholeNumbers}) {
    for (int round = 0; round < 60; ++round) {
      SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << " round " << round);
      const Case c = RandomCase(kind, 1 + static_cast<int>(rng.Below(7)), rng);
      ExpectTour(c, Oracle(c, EveryOrder_m));
    }
  }
}

TEST(SubsetTour, NineCellsAreThoseOfDepthFirstSearch) {
  Rng rng(2);
  for (const Kind kind : {Kind::kPlane, Kind::kAnyMatrix, Kind::kWholeNumbers}) {
    for (int round = 0; round < 4; ++round) {
      SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << " round " << round);
      Case c = RandomCase(kind, 9, rng);
      c.sampling_s = 0.5;
      ExpectTour(c, Oracle(c, DepthFirst_m));
    }
  }
}

TEST(SubsetTour, TheWayEndsAtTheFarthestCellEvenIfThatIsLonger) {
  // On an arc around the robot, the farthest in the middle: 31 m from one end to the other.
  const Case arc{
      {10.0, 11.0, 10.0}, {0.0, 10.5, 17.0, 10.5, 0.0, 10.5, 17.0, 10.5, 0.0}, {1.0, 1.0, 1.0}, 3};
  const absl::StatusOr<SubsetTour> tour = arc.Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_EQ(tour->order.back(), 1);
  EXPECT_EQ(tour->length_m, 10.0 + 17.0 + 10.5);
}

TEST(SubsetTour, OfEquallyFarCellsTheWayEndsAtTheFirst) {
  const absl::StatusOr<SubsetTour> tour = OnALine({5.0, -5.0}, {1.0, 1.0}, 2).Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_THAT(tour->order, ElementsAre(1, 0));
}

TEST(SubsetTour, OfEqualRewardsTheShorterWayWins) {
  // 0.1 + 0.2 + 0.3 > 0.3 + 0.2 + 0.1 in floating point, which must not count.
  Case c = OnALine({8.0, 8.0, 8.0, -2.0, -2.0, -2.0}, {0.1, 0.2, 0.3, 0.3, 0.2, 0.1}, 3);
  c.cycle_s = 8.5;  // not for both groups
  const absl::StatusOr<SubsetTour> tour = c.Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_THAT(tour->order, testing::UnorderedElementsAre(3, 4, 5));
  EXPECT_EQ(tour->feasible_subsets, 2);
}

TEST(SubsetTour, OfEqualRewardsAndWaysTheFirstCellsWin) {
  const absl::StatusOr<SubsetTour> tour =
      OnALine({1.0, 1.0, 1.0, 1.0}, {2.0, 2.0, 2.0, 2.0}, 2).Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_THAT(tour->order, testing::UnorderedElementsAre(0, 1));
  EXPECT_EQ(tour->feasible_subsets, 6);
}

TEST(SubsetTour, ALongCycleFitsEverySubset) {
  Rng rng(3);
  Case c = RandomCase(Kind::kPlane, 15, rng);
  c.wanted = 10;
  c.cycle_s = 1e6;
  const absl::StatusOr<SubsetTour> tour = c.Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_EQ(tour->feasible_subsets, 3003);  // [LHR] IV-A
  std::vector<double> rewards = c.rewards;
  std::sort(rewards.rbegin(), rewards.rend());
  double best = 0.0;
  for (int i = 0; i < 10; ++i) best += rewards[static_cast<std::size_t>(i)];
  EXPECT_DOUBLE_EQ(tour->reward, best);
}

TEST(SubsetTour, NegativeRewardsAreStillSampled) {
  const absl::StatusOr<SubsetTour> tour = OnALine({1.0, 2.0, 3.0}, {-3.0, -1.0, -2.0}, 2).Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_THAT(tour->order, ElementsAre(1, 2));
  EXPECT_EQ(tour->reward, -3.0);
}

TEST(SubsetTour, AtTheLowerBoundOfTheCycleTheClosestCellsFit) {
  // [LHR] Remark 1 with equality, where neither 0.1 m nor its multiples are binary fractions.
  Case c = OnALine({0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}, std::vector<double>(7, 1.0), 7);
  c.sampling_s = 2.3;
  c.speed_mps = 0.3;
  c.cycle_s = 7 * c.sampling_s + 7 * 0.1 / c.speed_mps;
  const absl::StatusOr<SubsetTour> tour = c.Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_EQ(tour->order.size(), 7U);
}

TEST(SubsetTour, FewerCellsLeaveMoreTimeToDrive) {
  // Three cells leave 10 - 3 * 3 s for 4 m; two leave 4 s, enough for cells 1 and 2.
  Case c = OnALine({-3.0, 3.0, 4.0}, {5.0, 1.0, 1.0}, 3);
  c.cycle_s = 10.0;
  c.sampling_s = 3.0;
  const absl::StatusOr<SubsetTour> tour = c.Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_THAT(tour->order, ElementsAre(1, 2));
  EXPECT_EQ(tour->feasible_subsets, 1);
}

TEST(SubsetTour, NothingIsSampledIfNothingFits) {
  Case c = OnALine({3.0, 4.0}, {1.0, 1.0}, 2);
  c.cycle_s = 2.9;
  ExpectTour(c, {});
  c.sampling_s = 50.0;
  ExpectTour(c, {});
}

TEST(SubsetTour, CellsWithoutAWayAreLeft) {
  Case c = OnALine({1.0, 2.0, 3.0}, {9.0, 1.0, 1.0}, 2);
  c.from_start_m[0] = c.between_m[1] = c.between_m[2] = c.between_m[3] = c.between_m[6] = kNoWay_m;
  const absl::StatusOr<SubsetTour> tour = c.Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_THAT(tour->order, ElementsAre(1, 2));
  c.from_start_m.assign(3, kNoWay_m);
  EXPECT_THAT(c.Solve()->order, IsEmpty());
}

TEST(SubsetTour, ALimitBeyondAllNumbersDoesNotLetMissingWaysFit) {
  Case c = OnALine({1.0, 2.0}, {1.0, 1.0}, 2);
  c.speed_mps = std::numeric_limits<double>::max();
  c.from_start_m.assign(2, kNoWay_m);
  EXPECT_THAT(c.Solve()->order, IsEmpty());
}

TEST(SubsetTour, SixteenCellsAreTheMost) {
  Rng rng(4);
  Case c = RandomCase(Kind::kPlane, kMaxTourCells, rng);
  c.wanted = kMaxTourCells;
  c.cycle_s = 1e6;
  const absl::StatusOr<SubsetTour> tour = c.Solve();
  ASSERT_TRUE(tour.ok()) << tour.status();
  EXPECT_EQ(tour->order.size(), 16U);
  EXPECT_NEAR(tour->length_m, WayLength_m(c, tour->order), 1e-9);
}

std::string Refusal(const Case& c) {
  const absl::Status status = c.Solve().status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  return std::string(status.message());
}

TEST(SubsetTour, BadNumbersAreRefusedByIndexAndValue) {
  const Case good = OnALine({1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}, 2);
  for (const double bad : {std::nan(""), -1.0, -kNoWay_m}) {
    Case c = good;
    c.from_start_m[2] = bad;
    EXPECT_THAT(Refusal(c), HasSubstr("from_start_m[2] = ")) << bad;
    c = good;
    c.between_m[5] = bad;
    EXPECT_THAT(Refusal(c), HasSubstr("between_m[5] = ")) << bad;
  }
  for (const double bad : {std::nan(""), kNoWay_m, -kNoWay_m}) {
    Case c = good;
    c.rewards[1] = bad;
    EXPECT_THAT(Refusal(c), HasSubstr("rewards[1] = ")) << bad;
  }
}

TEST(SubsetTour, NumbersOfCellsOutOfRangeAreRefused) {
  Case c = OnALine({1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}, 4);
  EXPECT_THAT(Refusal(c), HasSubstr("wanted = 4 must be in [1, 3]"));
  c.wanted = 0;
  EXPECT_THAT(Refusal(c), HasSubstr("wanted = 0"));
  EXPECT_THAT(Refusal({}), HasSubstr("number of cells = 0"));
  EXPECT_THAT(Refusal(OnALine(std::vector<double>(17, 1.0), std::vector<double>(17, 1.0), 1)),
              HasSubstr("number of cells = 17"));
}

TEST(SubsetTour, ListsOfUnequalSizesAreRefused) {
  Case c = OnALine({1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}, 2);
  c.from_start_m.pop_back();
  EXPECT_THAT(Refusal(c), HasSubstr("from_start_m"));
  c.from_start_m.push_back(3.0);
  c.between_m.push_back(0.0);
  EXPECT_THAT(Refusal(c), HasSubstr("between_m"));
}

TEST(SubsetTour, TimesAndSpeedOutOfRangeAreRefused) {
  const Case good = OnALine({1.0}, {1.0}, 1);
  for (const double bad : {std::nan(""), -1.0, kNoWay_m}) {
    Case c = good;
    c.cycle_s = bad;
    EXPECT_THAT(Refusal(c), HasSubstr("cycle_s = "));
    c = good;
    c.sampling_s = bad;
    EXPECT_THAT(Refusal(c), HasSubstr("sampling_s = "));
    c = good;
    c.speed_mps = bad;
    EXPECT_THAT(Refusal(c), HasSubstr("speed_mps = "));
  }
}

}  // namespace subset_tour_test
}  // namespace plumescout
