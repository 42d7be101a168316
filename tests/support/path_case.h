// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/grid/flood.h"
#include "core/plan/paths/path_planner.h"
#include "tests/support/plan_map.h"

namespace plumescout::testing {

// A random planning problem with goals that can be reached.
class PathCase {
 public:
  struct Shape {
    int width = 60;
    int height = 50;
    int obstacles = 25;
    int goals = 4;
  };

  explicit PathCase(std::uint64_t seed, const Shape& shape, CostKind kind = CostKind::kUcb,
                    double alpha_per_m = 0.0)
      : rng_(seed),
        open(RandomObstacles(shape.width, shape.height, shape.obstacles, rng_)),
        information(WavyInformation(open, rng_)),
        cost(information, kind, alpha_per_m),
        start_cell(RandomOpenCell(open, rng_)),
        reachable(ReachableCells(open, {start_cell})) {
    start = open.geometry().Center(start_cell);
    for (int i = 0; i < shape.goals; ++i) {
      goals.push_back(GoalAt(RandomOpenCell(reachable, rng_), open.geometry()));
    }
  }
  explicit PathCase(std::uint64_t seed) : PathCase(seed, Shape{}) {}
  PathCase(const PathCase&) = delete;  // `cost` refers to `information`
  PathCase& operator=(const PathCase&) = delete;

  PathProblem Problem(std::uint64_t seed = 1, std::int64_t max_edge_evaluations = 0) const {
    return {cost, reachable, start, goals, seed, max_edge_evaluations, stop};
  }

 private:
  Rng rng_;

 public:
  Grid<std::uint8_t> open;
  InformationMap information;
  EdgeCost cost;
  Cell start_cell;
  Grid<std::uint8_t> reachable;
  Point2 start;
  std::vector<Goal> goals;
  StopFn stop = NeverStop();
};

}  // namespace plumescout::testing
