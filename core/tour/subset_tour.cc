// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/subset_tour.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

using Subset = std::uint32_t;  // bit i: cell i
using Row = std::array<double, kMaxTourCells>;

constexpr double kNoWay_m = std::numeric_limits<double>::infinity();

// A way as long as the limit fits, whatever the rounding of its legs: at the lower bound of t_up,
// [LHR] Remark 1, the closest cells have to.
constexpr double kRounding = 1e-9;

Subset Bit(int cell) { return Subset{1} << cell; }

// The next greater subset with as many cells; REQUIRES: subset != 0.
Subset NextOfItsSize(Subset subset) {
  const Subset lowest = subset & -subset;
  const Subset carried = subset + lowest;
  return carried | (((subset ^ carried) >> 2) / lowest);
}

// Calls visit(cell) for each cell of the subset, in ascending order.
template <typename Visit>
void ForEachCell(Subset subset, const Visit& visit) {
  for (; subset != 0; subset &= subset - 1) visit(std::countr_zero(subset));
}

// Length of the shortest way from the start through all cells of a subset, in any order, and then
// to one more cell.
class WayTable {
 public:
  // For subsets of fewer than `problem.wanted` cells.
  explicit WayTable(const SubsetTourProblem& problem);

  // From the start through all cells of the subset to `last`, which is one of them.
  double Length_m(Subset subset, int last) const {
    return RowOf(subset & ~Bit(last))[static_cast<std::size_t>(last)];
  }

  // The cells of that way in order; of equally short ones, backwards, by the least index.
  std::vector<int> Order(Subset subset, int last) const;

 private:
  // The part of the way from `before`, the last but one, on.
  double Leg_m(int before, int last) const {
    return legs_m_[static_cast<std::size_t>(before)][static_cast<std::size_t>(last)];
  }
  Row& RowOf(Subset subset) { return rows_[subset]; }
  const Row& RowOf(Subset subset) const { return rows_[subset]; }
  void FillRow(Subset subset);

  std::array<Row, kMaxTourCells> legs_m_;
  std::unique_ptr<Row[]> rows_;  // [subset][last]: a row is written only where it is wanted
};

WayTable::WayTable(const SubsetTourProblem& problem) {
  const std::size_t cells = problem.rewards.size();
  for (std::size_t from = 0; from < cells; ++from) {
    legs_m_[from].fill(kNoWay_m);
    std::copy_n(problem.between_m.begin() + static_cast<std::ptrdiff_t>(from * cells), cells,
                legs_m_[from].begin());
  }
  const Subset end = Subset{1} << cells;
  rows_ = std::make_unique_for_overwrite<Row[]>(end);
  RowOf(0).fill(kNoWay_m);
  std::copy(problem.from_start_m.begin(), problem.from_start_m.end(), RowOf(0).begin());
  for (Subset subset = 1; subset < end; ++subset) {
    if (std::popcount(subset) < problem.wanted) FillRow(subset);
  }
}

// Held and Karp: the last but one is any cell of the subset. All ends at once.
void WayTable::FillRow(Subset subset) {
  Row best_m;
  best_m.fill(kNoWay_m);
  ForEachCell(subset, [&](int before) {
    const double so_far_m = Length_m(subset, before);
    const Row& legs_m = legs_m_[static_cast<std::size_t>(before)];
    for (std::size_t last = 0; last < best_m.size(); ++last) {
      const double length_m = so_far_m + legs_m[last];
      best_m[last] = length_m < best_m[last] ? length_m : best_m[last];
    }
  });
  RowOf(subset) = best_m;
}

std::vector<int> WayTable::Order(Subset subset, int last) const {
  std::vector<int> order = {last};
  for (Subset open = subset & ~Bit(last); open != 0; open &= ~Bit(order.back())) {
    int best = -1;
    double best_m = kNoWay_m;
    ForEachCell(open, [&](int before) {
      const double length_m = Length_m(open, before) + Leg_m(before, order.back());
      if (length_m >= best_m) return;
      best = before;
      best_m = length_m;
    });
    order.push_back(best);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

absl::Status CheckDistances(const char* name, std::span<const double> distances_m) {
  for (std::size_t i = 0; i < distances_m.size(); ++i) {
    if (distances_m[i] >= 0.0) continue;
    return absl::InvalidArgumentError(
        absl::StrCat(name, "[", i, "] = ", distances_m[i], " must be >= 0"));
  }
  return absl::OkStatus();
}

absl::Status CheckRewards(std::span<const double> rewards) {
  for (std::size_t i = 0; i < rewards.size(); ++i) {
    if (std::isfinite(rewards[i])) continue;
    return absl::InvalidArgumentError(
        absl::StrCat("rewards[", i, "] = ", rewards[i], " must be finite"));
  }
  return absl::OkStatus();
}

absl::Status CheckProblem(const SubsetTourProblem& problem) {
  const auto cells = static_cast<double>(problem.rewards.size());
  const absl::Status sizes =
      Checker()
          .InRange("number of cells", cells, 1, kMaxTourCells)
          .InRange("size of from_start_m", static_cast<double>(problem.from_start_m.size()), cells,
                   cells)
          .InRange("size of between_m", static_cast<double>(problem.between_m.size()),
                   cells * cells, cells * cells)
          .InRange("wanted", problem.wanted, 1, cells)
          .Positive("cycle_s", problem.cycle_s)
          .InRange("sampling_s", problem.sampling_s, 0.0, std::numeric_limits<double>::max())
          .Positive("speed_mps", problem.speed_mps)
          .status();
  PLUMESCOUT_RETURN_IF_ERROR(sizes);
  PLUMESCOUT_RETURN_IF_ERROR(CheckDistances("from_start_m", problem.from_start_m));
  PLUMESCOUT_RETURN_IF_ERROR(CheckDistances("between_m", problem.between_m));
  return CheckRewards(problem.rewards);
}

// All subsets of one size against each other.
class Contest {
 public:
  explicit Contest(const SubsetTourProblem& problem) : problem_(problem), ways_(problem) {
    by_reward_.resize(problem.rewards.size());
    std::iota(by_reward_.begin(), by_reward_.end(), 0);
    std::stable_sort(by_reward_.begin(), by_reward_.end(),
                     [this](int a, int b) { return RewardOf(a) > RewardOf(b); });
  }

  SubsetTour Best(int size) const;

 private:
  double RewardOf(int cell) const { return problem_.rewards[static_cast<std::size_t>(cell)]; }
  double SumOfRewards(Subset subset) const {
    double sum = 0.0;
    for (const int cell : by_reward_) sum += (subset & Bit(cell)) != 0 ? RewardOf(cell) : 0.0;
    return sum;
  }
  int Farthest(Subset subset) const;

  const SubsetTourProblem& problem_;
  WayTable ways_;
  std::vector<int> by_reward_;  // cells by falling reward
};

int Contest::Farthest(Subset subset) const {
  const std::span<const double> from_start_m = problem_.from_start_m;
  int farthest = std::countr_zero(subset);
  ForEachCell(subset, [&](int cell) {
    if (from_start_m[static_cast<std::size_t>(cell)] >
        from_start_m[static_cast<std::size_t>(farthest)]) {
      farthest = cell;
    }
  });
  return farthest;
}

SubsetTour Contest::Best(int size) const {
  const double driving_s = problem_.cycle_s - size * problem_.sampling_s;
  const double limit_m = driving_s * problem_.speed_mps * (1.0 + kRounding);
  SubsetTour best;
  Subset winner = 0;
  for (Subset subset = Bit(size) - 1; subset < Bit(static_cast<int>(by_reward_.size()));
       subset = NextOfItsSize(subset)) {
    const double length_m = ways_.Length_m(subset, Farthest(subset));
    if (!(length_m <= limit_m && length_m < kNoWay_m)) continue;
    ++best.feasible_subsets;
    const double reward = SumOfRewards(subset);
    const bool wins =
        winner == 0 || reward > best.reward || (reward == best.reward && length_m < best.length_m);
    if (!wins) continue;
    winner = subset;
    best.reward = reward;
    best.length_m = length_m;
  }
  if (winner != 0) best.order = ways_.Order(winner, Farthest(winner));
  return best;
}

}  // namespace

absl::StatusOr<SubsetTour> BestSubsetTour(const SubsetTourProblem& problem) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckProblem(problem));
  const Contest contest(problem);
  SubsetTour best;
  for (int size = problem.wanted; size > 0 && best.order.empty(); --size) {
    best = contest.Best(size);
  }
  return best;
}

}  // namespace plumescout
