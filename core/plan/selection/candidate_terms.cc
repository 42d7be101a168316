// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/candidate_terms.h"

#include <cmath>
#include <cstddef>

#include "core/grid/ray.h"

namespace plumescout {
namespace {

// Mean of `value(cell)` along the polyline, weighted by length.
template <typename Value>
double MeanAlong(const GridGeometry& geometry, const std::vector<Point2>& path, Value&& value) {
  double sum = 0.0;
  double length_cells = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    WalkSegment(geometry, path[i - 1], path[i], [&](Cell cell, double inside_cells) {
      sum += value(cell) * inside_cells;
      length_cells += inside_cells;
      return true;
    });
  }
  return length_cells > 0.0 ? sum / length_cells : value(geometry.CellAt(path.front()));
}

}  // namespace

Candidate MakeCandidate(const Goal& goal, const std::vector<Point2>& path, PathSource source,
                        const CandidateJudge& judge) {
  const InformationMap& information = judge.selection_cost.information();
  const GridGeometry& geometry = judge.selection_cost.geometry();
  Candidate candidate;
  candidate.goal = goal;
  candidate.path = path;
  candidate.path_source = source;
  candidate.cost = PathCost(judge.selection_cost, path);
  for (std::size_t i = 1; i < path.size(); ++i) {
    candidate.information_penalty +=
        SegmentIntegral_cells(information.penalty, path[i - 1], path[i]);
    candidate.length_m += Distance_m(path[i - 1], path[i]);
  }
  candidate.mean_ucb = MeanAlong(
      geometry, path, [&](Cell cell) { return static_cast<double>(information.value[cell]); });
  candidate.mean_concentration_ppm = MeanAlong(geometry, path, [&](Cell cell) {
    const double mean_ppm = judge.mean_ppm[cell];
    return std::isfinite(mean_ppm) ? mean_ppm : judge.background_mean_ppm;
  });
  return candidate;
}

}  // namespace plumescout
