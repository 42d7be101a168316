// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/candidate_terms.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "core/grid/ray.h"

namespace plumescout {
namespace {

// Integrals along a polyline, each over the cells that it crosses, in units of cells.
class Integrals {
 public:
  Integrals(const std::vector<Point2>& path, const CandidateJudge& judge)
      : judge_(judge), information_(judge.selection_cost.information()) {
    for (std::size_t i = 1; i < path.size(); ++i) Add(path[i - 1], path[i]);
    if (length_cells_ > 0.0) return;
    const Cell cell = judge.selection_cost.geometry().CellAt(path.front());
    length_cells_ = 1.0;
    ucb_ = information_.value[cell];
    mean_ppm_ = MeanAt_ppm(cell);
  }

  double cost() const { return cost_; }
  double penalty_cells() const { return penalty_cells_; }
  double mean_ucb() const { return ucb_ / length_cells_; }
  double mean_ppm() const { return mean_ppm_ / length_cells_; }

 private:
  void Add(Point2 a, Point2 b) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double penalty_cells = 0.0;  // SegmentIntegral_cells
    const auto visit = [&](Cell cell, double inside_cells) {
      const double penalty = information_.penalty[cell];
      penalty_cells += penalty == kInfinity ? kInfinity : penalty * inside_cells;
      ucb_ += static_cast<double>(information_.value[cell]) * inside_cells;
      mean_ppm_ += MeanAt_ppm(cell) * inside_cells;
      length_cells_ += inside_cells;
      return true;
    };
    WalkSegment(judge_.selection_cost.geometry(), a, b, visit);
    cost_ += judge_.selection_cost.OfPenalty(penalty_cells, a, b);
    penalty_cells_ += penalty_cells;
  }

  double MeanAt_ppm(Cell cell) const {
    const double mean_ppm = judge_.mean_ppm[cell];
    return std::isfinite(mean_ppm) ? mean_ppm : judge_.background_mean_ppm;
  }

  const CandidateJudge& judge_;
  const InformationMap& information_;
  double cost_ = 0.0;
  double penalty_cells_ = 0.0;
  double length_cells_ = 0.0;
  double ucb_ = 0.0;
  double mean_ppm_ = 0.0;
};

}  // namespace

Candidate MakeCandidate(const Goal& goal, const std::vector<Point2>& path, PathSource source,
                        const CandidateJudge& judge) {
  Candidate candidate;
  candidate.goal = goal;
  candidate.path = path;
  candidate.path_source = source;
  const Integrals integrals(path, judge);
  candidate.cost = integrals.cost();
  candidate.information_penalty = integrals.penalty_cells();
  candidate.mean_ucb = integrals.mean_ucb();
  candidate.mean_concentration_ppm = integrals.mean_ppm();
  for (std::size_t i = 1; i < path.size(); ++i) {
    candidate.length_m += Distance_m(path[i - 1], path[i]);
  }
  return candidate;
}

}  // namespace plumescout
