// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Plans in random halls, against exact searches of the grid under the same cost: CPU time, share
// of goals reached, and how much dearer the paths are.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/grid/flood.h"
#include "core/plan/edge_cost.h"
#include "core/plan/information_field.h"
#include "core/plan/paths/grid_exact.h"
#include "core/plan/paths/grid_guard.h"
#include "core/plan/paths/xit.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "lab/bench/bench_summary.h"
#include "lab/bench/grid_oracle.h"
#include "lab/bench/random_world.h"

namespace plumescout::lab {
namespace {

constexpr int kGoals = 5;
constexpr int kRepeats = 9;
const StopFn kNeverStop = NeverStop();

// One world with what path planners see of it.
struct Case {
  explicit Case(std::uint64_t seed)
      : world(MakeRandomWorld(seed, kGoals)),
        field(MakeInformationField(
            {*world.belief.traversable, *world.belief.gas_mean_ppm, *world.belief.gas_variance_ppm2,
             world.belief.options->gas, world.belief.options->frontier},
            PlanningOptions{})),
        cost(field, CostKind::kUcb, 0.0),
        start(world.belief.robots.at(world.robot).state.pose.position()),
        start_cell(world.belief.geometry().CellAt(start)),
        reachable(ReachableCells(*world.belief.traversable, {start_cell})) {}

  Case(const Case&) = delete;  // `cost` refers to `field`
  Case& operator=(const Case&) = delete;

  PathProblem Problem(std::uint64_t seed) const {
    return {cost, reachable, start, world.goals, seed, 0, kNeverStop};
  }

  RandomWorld world;
  InformationField field;
  EdgeCost cost;
  Point2 start;
  Cell start_cell;
  Grid<std::uint8_t> reachable;
};

// Prices over those of an oracle, of the goals that were reached, and how many were.
struct Quality {
  std::vector<double> over_d8;
  std::vector<double> over_d32;
  int reached = 0;
  int goals = 0;

  void Add(const PathResult& result, const Case& c, const Grid<double>& d8,
           const Grid<double>& d32) {
    for (std::size_t i = 0; i < result.paths.size(); ++i) {
      ++goals;
      if (!result.paths[i]) continue;
      ++reached;
      over_d8.push_back(result.paths[i]->cost / d8[c.world.goals[i].cell]);
      over_d32.push_back(result.paths[i]->cost / d32[c.world.goals[i].cell]);
    }
  }
  double ReachedRatio() const { return static_cast<double>(reached) / goals; }
};

double Mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

struct Figures {
  std::vector<double> plan_ms, all_goals_ms, search_ms, guard_ms;
  std::vector<double> exact_ms;
  Quality exact;
  Quality tree;
  Quality guarded;
};

absl::Status MeasurePlan(const Case& c, bool draw_goals, std::vector<double>& times_ms) {
  PlanningOptions options;
  options.draw_goals = draw_goals;
  options.max_goals = kGoals;
  auto strategy = MakeStrategy(options);
  PLUMESCOUT_RETURN_IF_ERROR(strategy.status());
  PlanRequest request;
  request.robot = c.world.robot;
  absl::Status status;
  times_ms.push_back(MedianCpu_ms(
      kRepeats, [&] { status = (*strategy)->Plan(c.world.belief, request, kNeverStop).status(); }));
  return status;
}

void MeasureSearch(const Case& c, std::uint64_t seed, Figures& figures) {
  const XitPlanner xit{PlanningOptions{}};
  const PathProblem problem = c.Problem(seed);
  PathResult result;
  figures.search_ms.push_back(MedianCpu_ms(kRepeats, [&] { result = xit.FindPaths(problem); }));
  const Grid<double> d8 = OracleCosts(c.cost, c.start_cell, 8);
  const Grid<double> d32 = OracleCosts(c.cost, c.start_cell, 32);
  figures.tree.Add(result, c, d8, d32);
  CompleteOnGrid(problem, PathSource::kGridGuard, result);
  figures.guarded.Add(result, c, d8, d32);
  const GridExactPlanner exact;
  PathResult exact_result;
  figures.exact_ms.push_back(
      MedianCpu_ms(kRepeats, [&] { exact_result = exact.FindPaths(problem); }));
  figures.exact.Add(exact_result, c, d8, d32);
  figures.guard_ms.push_back(MedianCpu_ms(kRepeats, [&] {  // with every goal missed
    PathResult nothing;
    nothing.paths.resize(c.world.goals.size());
    CompleteOnGrid(problem, PathSource::kGridGuard, nothing);
  }));
}

absl::Status Measure(int worlds, BenchSummary& summary) {
  Figures figures;
  for (int i = 0; i < worlds; ++i) {
    const std::uint64_t seed = summary.seed() + static_cast<std::uint64_t>(i);
    const Case c(seed);
    PLUMESCOUT_RETURN_IF_ERROR(MeasurePlan(c, true, figures.plan_ms));
    PLUMESCOUT_RETURN_IF_ERROR(MeasurePlan(c, false, figures.all_goals_ms));
    MeasureSearch(c, seed, figures);
  }
  summary.Set("worlds", worlds);
  summary.Set("xit300_ms", Median(figures.plan_ms));
  summary.Set("xit300_worst_ms", *std::max_element(figures.plan_ms.begin(), figures.plan_ms.end()));
  summary.Set("xit300_all_goals_ms", Median(figures.all_goals_ms));
  summary.Set("xit300_search_ms", Median(figures.search_ms));
  summary.Set("grid_guard_ms", Median(figures.guard_ms));
  summary.Set("grid_exact_ms", Median(figures.exact_ms));
  summary.Set("grid_exact_over_d8", Mean(figures.exact.over_d8));
  summary.Set("grid_exact_over_d32", Mean(figures.exact.over_d32));
  summary.Set("xit300_reached_ratio", figures.guarded.ReachedRatio());
  summary.Set("xit300_tree_only_reached_ratio", figures.tree.ReachedRatio());
  summary.Set("xit300_over_d8", Mean(figures.guarded.over_d8));
  summary.Set("xit300_over_d32", Mean(figures.guarded.over_d32));
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  CLI::App app("Plans in random halls: CPU time, goals reached, price over exact grid searches");
  int worlds = 50;
  app.add_option("--worlds", worlds, "random worlds")->check(CLI::PositiveNumber);
  return plumescout::lab::RunBench(app, argc, argv, [&](plumescout::lab::BenchSummary& summary) {
    return plumescout::lab::Measure(worlds, summary);
  });
}
