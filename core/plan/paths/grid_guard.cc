// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/grid_guard.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "core/grid/neighbours.h"
#include "core/grid/padded.h"
#include "core/plan/paths/shortcut.h"

namespace plumescout {
namespace {

constexpr float kBlockedPenalty = std::numeric_limits<float>::infinity();
constexpr double kUnreached = std::numeric_limits<double>::infinity();
constexpr int kNoParent = -1;
// Buckets for the dearest step: few enough that most are not empty, many enough that few cells
// are visited twice. Any number gives the same costs.
constexpr int kBucketsPerStep = 16;
constexpr int kVisitsBetweenStops = 512;  // some tens of microseconds

// Dijkstra under the edge cost with a ring of buckets. A step may be cheaper than a bucket is wide,
// so a bucket is visited until it stays empty; a cell that got better meanwhile is visited again.
class GridSearch {
 public:
  explicit GridSearch(const EdgeCost& cost)
      : cost_(cost),
        penalty_(PaddedFrom<float>(cost.field().penalty, kBlockedPenalty,
                                   [](float penalty) { return penalty; })),
        g_(cost.geometry(), kUnreached, kUnreached),
        parent_(cost.geometry(), kNoParent, kNoParent),
        offsets_(penalty_.NeighbourOffsets()),
        bucket_width_(cost.GridStep(1.0F, 1.0F, kDiagonalStep_cells) / kBucketsPerStep) {}

  // Settles all `goals` or all that can be reached. False if `stop` said so first.
  bool Run(Cell start, const std::vector<Cell>& goals, const StopFn& stop) {
    Reach(penalty_.IndexOf(start), kNoParent, 0.0);
    int visits = 0;
    for (; waiting_ > 0 && !Settled(goals); ++level_) {
      std::vector<Entry>& bucket = BucketOf(level_);
      for (std::size_t i = 0; i < bucket.size(); ++i) {
        const Entry entry = bucket[i];
        --waiting_;
        if (entry.g == g_[entry.cell]) ReachNeighbours(entry);
        if (++visits % kVisitsBetweenStops == 0 && stop()) return false;
      }
      bucket.clear();
    }
    return true;
  }

  // Cells from the start to `goal`; empty if it was not reached.
  std::vector<Cell> PathTo(Cell goal) const {
    std::vector<Cell> path;
    if (g_[g_.IndexOf(goal)] == kUnreached) return path;
    for (int cell = g_.IndexOf(goal); cell != kNoParent; cell = parent_[cell]) {
      path.push_back(g_.CellAt(cell));
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  struct Entry {
    int cell;
    double g;
  };

  // A step leads at most kBucketsPerStep buckets on, one more with rounding.
  static constexpr std::size_t kBuckets = kBucketsPerStep + 2;

  std::int64_t LevelOf(double g) const { return static_cast<std::int64_t>(g / bucket_width_); }
  std::vector<Entry>& BucketOf(std::int64_t level) {
    return buckets_[static_cast<std::size_t>(level) % kBuckets];
  }

  // Whether no goal can become cheaper: all lie in buckets done with.
  bool Settled(const std::vector<Cell>& goals) const {
    return std::all_of(goals.begin(), goals.end(), [this](Cell goal) {
      const double g = g_[g_.IndexOf(goal)];
      return g < kUnreached && LevelOf(g) < level_;
    });
  }

  void Reach(int cell, int parent, double g) {
    if (!(g < g_[cell])) return;
    g_[cell] = g;
    parent_[cell] = parent;
    BucketOf(std::max(LevelOf(g), level_)).push_back({cell, g});
    ++waiting_;
  }

  void ReachNeighbours(const Entry& from) {
    const float penalty = penalty_[from.cell];
    std::array<bool, 4> open{};
    for (std::size_t k = 0; k < kNeighbours8.size(); ++k) {
      const int to = from.cell + offsets_[k];
      const bool passable = penalty_[to] != kBlockedPenalty;
      const bool diagonal = k >= 4;
      if (!diagonal) open[k] = passable;
      // Diagonal k lies between the straight steps k - 4 and k - 3.
      if (!passable || (diagonal && !(open[k - 4] && open[(k - 3) % 4]))) continue;
      Reach(to, from.cell,
            from.g + cost_.GridStep(penalty, penalty_[to],
                                    diagonal ? kDiagonalStep_cells : kStraightStep_cells));
    }
  }

  const EdgeCost& cost_;
  Padded<float> penalty_;
  Padded<double> g_;
  Padded<int> parent_;
  std::array<int, 8> offsets_;
  double bucket_width_;
  std::array<std::vector<Entry>, kBuckets> buckets_;
  std::int64_t level_ = 0;
  std::int64_t waiting_ = 0;  // entries not visited yet
};

// The polyline along `cells`, from the start itself.
std::vector<Point2> Polyline(const PathProblem& problem, const std::vector<Cell>& cells) {
  std::vector<Point2> points = {problem.start};
  for (const Cell cell : cells) {
    const Point2 center = problem.cost.geometry().Center(cell);
    if (center != points.back()) points.push_back(center);
  }
  return WithoutCollinear(points);
}

std::vector<Cell> MissedGoals(const PathProblem& problem, const PathResult& result) {
  std::vector<Cell> missed;
  for (std::size_t i = 0; i < result.paths.size(); ++i) {
    const Cell cell = problem.goals[i].cell;
    if (!result.paths[i] && problem.reachable.At(cell, 0) != 0) missed.push_back(cell);
  }
  return missed;
}

}  // namespace

void CompleteOnGrid(const PathProblem& problem, PathResult& result) {
  const std::vector<Cell> missed = MissedGoals(problem, result);
  bool stopped = false;
  if (!missed.empty()) {
    GridSearch search(problem.cost);
    stopped = !search.Run(problem.start_cell(), missed, problem.stop);
    for (std::size_t i = 0; i < result.paths.size(); ++i) {
      if (result.paths[i] || problem.reachable.At(problem.goals[i].cell, 0) == 0) continue;
      const std::vector<Cell> cells = search.PathTo(problem.goals[i].cell);
      if (cells.empty()) continue;
      ShortcutPath path = Shortcut(problem.cost, Polyline(problem, cells), problem.stop);
      result.effort.edges_evaluated += path.edges_evaluated;
      ++result.effort.goals_by_guard;
      result.paths[i] = {std::move(path.vertices), path.cost, PathSource::kGridGuard};
    }
  }
  const bool all = std::all_of(result.paths.begin(), result.paths.end(),
                               [](const auto& path) { return path.has_value(); });
  result.end = all       ? PlanEnd::kAllGoalsReached
               : stopped ? PlanEnd::kStopped
                         : PlanEnd::kQueueExhausted;
}

}  // namespace plumescout
