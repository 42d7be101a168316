// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Plans in random halls and large buildings: every planner of the registry on the same work,
// against exact searches of the grid under the same cost. CPU time, share of goals reached, and how
// much dearer the paths are.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "core/belief/belief.h"
#include "core/belief/objective_assessment.h"
#include "core/plan/paths/anytime_xit.h"
#include "core/plan/paths/path_planners.h"
#include "core/plan/selection/expected_information.h"
#include "core/plan/strategy.h"
#include "core/types/quantile.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/about/cpu_time.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"
#include "lab/bench/plan_case.h"
#include "lab/bench/planner_registry.h"
#include "lab/bench/team_plans.h"
#include "lab/worlds/grid_oracle.h"
#include "lab/worlds/known_building.h"
#include "lab/worlds/mid_mission.h"
#include "lab/worlds/random_world.h"

namespace plumescout::lab {
namespace {

constexpr int kGoals = 5;
const StopFn kNeverStop = NeverStop();

double Mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// One row: a planner on all worlds.
struct Row {
  std::vector<double> cpu_ms;
  std::vector<double> over_d8;  // of the goals that were reached
  std::vector<double> over_d32;
  int reached = 0;
  int goals = 0;

  void Add(const PathResult& result, const PlanCase& c, const Grid<double>& d8,
           const Grid<double>* d32) {
    for (std::size_t i = 0; i < result.paths.size(); ++i) {
      ++goals;
      if (!result.paths[i]) continue;
      ++reached;
      // A path as published ends beside the goal: judged by where it ends.
      const Cell end = c.cost.geometry().CellAt(result.paths[i]->vertices.back());
      if (!(d8[end] > 0.0)) continue;
      const double cost = PathCost(c.cost, result.paths[i]->vertices);
      over_d8.push_back(cost / d8[end]);
      if (d32 != nullptr) over_d32.push_back(cost / (*d32)[end]);
    }
  }
  double ReachedRatio() const { return static_cast<double>(reached) / goals; }
  void Set(const std::string& name, BenchSummary& summary) const {
    summary.Set(absl::StrCat(name, "_ms"), Median(cpu_ms));
    summary.Set(absl::StrCat(name, "_reached_ratio"), ReachedRatio());
    summary.Set(absl::StrCat(name, "_over_d8"), Mean(over_d8));
    if (!over_d32.empty()) summary.Set(absl::StrCat(name, "_over_d32"), Mean(over_d32));
  }
};

// A whole plan: frontiers, information map, search, selection.
absl::Status MeasureWholePlans(int worlds, BenchSummary& summary) {
  constexpr int kRepeats = 9;
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto strategy, MakeStrategy(PlanningOptions{}));
  std::vector<double> times_ms;
  absl::Status status;
  for (int i = 0; i < worlds; ++i) {
    const RandomWorld world =
        MakeRandomWorld(summary.seed() + static_cast<std::uint64_t>(i), kGoals);
    PlanRequest request;
    request.robot = world.robot;
    times_ms.push_back(MedianCpu_ms(kRepeats, [&] {
      status.Update(strategy->Plan(world.belief, request, kNeverStop).status());
    }));
  }
  summary.Set("whole_plan_ms", Median(times_ms));
  summary.Set("whole_plan_worst_ms", *std::max_element(times_ms.begin(), times_ms.end()));
  return status;
}

struct MissionSize {
  std::string name;
  int width_cells = 0;
  int height_cells = 0;
  int robots = 1;
  int rounds = 12;
};

// Plans that were told to stop at random moments.
struct StoppedPlans {
  std::vector<double> late_ms;  // by how much CPU time each outlived its stop
  double answered = 0.0;        // those that had a plan

  void Set(const std::string& name, BenchSummary& summary) const {
    constexpr double kTail = 0.99;
    summary.Set(name + "_late_after_stop_ms", Median(late_ms));
    summary.Set(name + "_late_after_stop_ms_p99", Quantile(late_ms, kTail));
    summary.Set(name + "_late_after_stop_ms_worst",
                *std::max_element(late_ms.begin(), late_ms.end()));
    summary.Set(name + "_stopped_answered_ratio", answered / static_cast<double>(late_ms.size()));
  }
};

void StopAtRandom(const Strategy& strategy, const PlanMoment& moment, double whole_ms, Rng& rng,
                  StoppedPlans& stopped) {
  constexpr int kStops = 25;
  PlanRequest request;
  request.robot = moment.robot;
  for (int i = 0; i < kStops; ++i) {
    const double limit_ms = whole_ms * rng.Uniform01();
    const double begin_ms = ThreadCpu_ms();
    const StopFn stop = [&] { return ThreadCpu_ms() - begin_ms >= limit_ms; };
    const bool answered = strategy.Plan(*moment.belief, request, stop).ok();
    const double late_ms = ThreadCpu_ms() - begin_ms - limit_ms;
    if (late_ms < 0.0) continue;  // it was quicker this time
    stopped.late_ms.push_back(late_ms);
    stopped.answered += answered ? 1.0 : 0.0;
  }
}

// What a mission with an objective looks at once a second.
double Assessment_ms(const Belief& belief) {
  constexpr int kRepeats = 5;
  auto options = std::make_shared<MissionOptions>(*belief.options);
  options->objective.kind = ObjectiveKind::kMapAboveThreshold;
  options->objective.threshold_ppm = 5.0;
  Belief with_objective = belief;
  with_objective.options = std::move(options);
  return MedianCpu_ms(kRepeats, [&] { AssessObjective(with_objective); });
}

// Whole plans of the default strategy in missions under way: frontiers, information map, search,
// pricing.
absl::Status MeasureMissions(const std::string& only, BenchSummary& summary) {
  constexpr int kRepeats = 5;
  const PlanningOptions options;
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto strategy, MakeStrategy(options));
  for (const MissionSize& size :
       {MissionSize{"16x20m", 160, 200, 1, 24}, MissionSize{"24x18m", 240, 180, 1, 24},
        MissionSize{"30x30m", 300, 300, 1, 40}, MissionSize{"16x20m_8_robots", 160, 200, 8, 12},
        MissionSize{"96x120m", 960, 1200, 1, 12}}) {
    if (!only.empty() && only != size.name) continue;
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<PlanMoment> moments,
                                RunToMidMission({.width_cells = size.width_cells,
                                                 .height_cells = size.height_cells,
                                                 .robots = size.robots,
                                                 .rounds = size.rounds,
                                                 .seed = summary.seed()}));
    std::vector<double> times_ms;
    std::vector<double> assessments_ms;
    StoppedPlans stopped;
    Rng rng(summary.seed());
    double candidates = 0.0;
    for (const PlanMoment& moment : moments) {
      PlanRequest request;
      request.robot = moment.robot;
      absl::StatusOr<Plan> plan;
      times_ms.push_back(MedianCpu_ms(
          kRepeats, [&] { plan = strategy->Plan(*moment.belief, request, kNeverStop); }));
      PLUMESCOUT_RETURN_IF_ERROR(plan.status());
      assessments_ms.push_back(Assessment_ms(*moment.belief));
      StopAtRandom(*strategy, moment, times_ms.back(), rng, stopped);
      candidates += static_cast<double>(plan->candidates.size());
    }
    const std::string name = "mission_plan_" + size.name;
    summary.Set(name + "_ms", Median(times_ms));
    summary.Set(name + "_worst_ms", *std::max_element(times_ms.begin(), times_ms.end()));
    stopped.Set(name, summary);
    summary.Set("objective_assessment_" + size.name + "_ms", Median(assessments_ms));
    summary.Set(name + "_candidates", candidates / static_cast<double>(moments.size()));
  }
  return absl::OkStatus();
}

// Every planner to the same five goals of the same halls.
void MeasureRegistry(int worlds, BenchSummary& summary) {
  constexpr int kRepeats = 5;
  const std::vector<RegisteredPlanner> planners = PlannerRegistry();
  std::vector<Row> rows(planners.size());
  for (int i = 0; i < worlds; ++i) {
    const std::uint64_t seed = summary.seed() + static_cast<std::uint64_t>(i);
    const PlanCase c(MakeRandomWorld(seed, kGoals));
    const Grid<double> d8 = OracleCosts(c.cost, c.start_cell, 8);
    const Grid<double> d32 = OracleCosts(c.cost, c.start_cell, 32);
    for (std::size_t k = 0; k < planners.size(); ++k) {
      PathResult result;
      // Rivals take up to seconds: once is enough.
      const auto run = [&] {
        result = planners[k].planner->FindPaths(c.Problem(seed, kNeverStop, planners[k].cost));
      };
      if (planners[k].is_rival) {
        const double begin_ms = ThreadCpu_ms();
        run();
        rows[k].cpu_ms.push_back(ThreadCpu_ms() - begin_ms);
      } else {
        rows[k].cpu_ms.push_back(MedianCpu_ms(kRepeats, run));
      }
      rows[k].Add(result, c, d8, &d32);
    }
  }
  double cheapest_rival_ms = std::numeric_limits<double>::quiet_NaN();
  double grid_exact_ms = 0.0;
  double grid_exact_over_d32 = 0.0;
  for (std::size_t k = 0; k < planners.size(); ++k) {
    rows[k].Set(planners[k].name, summary);
    if (planners[k].name != "grid_exact") continue;
    grid_exact_ms = Median(rows[k].cpu_ms);
    grid_exact_over_d32 = Mean(rows[k].over_d32);
  }
  for (std::size_t k = 0; k < planners.size(); ++k) {
    const bool reached_all = rows[k].reached == rows[k].goals;
    if (!planners[k].is_rival || !reached_all) continue;
    if (!(Mean(rows[k].over_d32) <= grid_exact_over_d32)) continue;
    cheapest_rival_ms = std::fmin(cheapest_rival_ms, Median(rows[k].cpu_ms));
  }
  summary.Set("rivals_no_dearer_over_grid_exact_ms_ratio", cheapest_rival_ms / grid_exact_ms);
}

// Anytime XIT under a deadline and a cancellation, by the CPU clock.
void MeasureAnytime(int worlds, BenchSummary& summary) {
  constexpr double kDeadline_ms = 20.0;
  constexpr double kCancel_ms = 7.0;
  const AnytimeXitPlanner anytime{PlanningOptions{}};
  Row row;
  double late_ms = 0.0;
  double late_after_cancel_ms = 0.0;
  for (int i = 0; i < worlds; ++i) {
    const std::uint64_t seed = summary.seed() + static_cast<std::uint64_t>(i);
    const PlanCase c(MakeRandomWorld(seed, kGoals));
    const auto run_until = [&](double limit_ms, PathResult& result) {
      const double begin_ms = ThreadCpu_ms();
      const StopFn stop = [&] { return ThreadCpu_ms() - begin_ms >= limit_ms; };
      result = anytime.FindPaths(c.Problem(seed, stop));
      return ThreadCpu_ms() - begin_ms;
    };
    PathResult result;
    row.cpu_ms.push_back(run_until(kDeadline_ms, result));
    late_ms = std::max(late_ms, row.cpu_ms.back() - kDeadline_ms);
    const Grid<double> d8 = OracleCosts(c.cost, c.start_cell, 8);
    const Grid<double> d32 = OracleCosts(c.cost, c.start_cell, 32);
    row.Add(result, c, d8, &d32);
    late_after_cancel_ms =
        std::max(late_after_cancel_ms, run_until(kCancel_ms, result) - kCancel_ms);
  }
  row.Set("anytime_xit_20ms", summary);
  summary.Set("anytime_xit_late_ms", late_ms);
  summary.Set("anytime_xit_late_after_cancel_ms", late_after_cancel_ms);
}

// The same by the wall clock, as callers wait: by how much a search outlives its deadline, and how
// soon it ends once another thread has cancelled it.
void MeasureStopsByWall(int worlds, BenchSummary& summary) {
  constexpr absl::Duration kDeadline = absl::Milliseconds(20);
  constexpr absl::Duration kCancelAfter = absl::Milliseconds(7);
  constexpr int kRepeats = 4;
  constexpr double kTail = 0.99;
  const AnytimeXitPlanner anytime{PlanningOptions{}};
  std::vector<double> overrun_ms;
  std::vector<double> cancel_ms;
  const auto since_ms = [](absl::Time time) {
    return std::max(0.0, absl::ToDoubleMilliseconds(absl::Now() - time));
  };
  for (int i = 0; i < worlds * kRepeats; ++i) {
    const std::uint64_t seed = summary.seed() + static_cast<std::uint64_t>(i % worlds);
    const PlanCase c(MakeRandomWorld(seed, kGoals));
    const absl::Time deadline = absl::Now() + kDeadline;
    const StopFn is_over = [&] { return absl::Now() >= deadline; };
    anytime.FindPaths(c.Problem(seed, is_over));
    overrun_ms.push_back(since_ms(deadline));

    std::atomic<bool> cancelled = false;
    absl::Time cancelled_at;
    std::thread caller([&] {
      absl::SleepFor(kCancelAfter);
      cancelled_at = absl::Now();
      cancelled = true;
    });
    const StopFn is_cancelled = [&] { return cancelled.load(); };
    anytime.FindPaths(c.Problem(seed, is_cancelled));
    if (cancelled) cancel_ms.push_back(since_ms(cancelled_at));
    caller.join();
  }
  summary.Set("deadline_overrun_wall_ms_p99", Quantile(overrun_ms, kTail));
  summary.Set("cancel_wall_ms_p99", Quantile(cancel_ms, kTail));
}

// How planners scale with the building, and what pricing the information of five ways costs.
absl::Status MeasureScaling(int worlds, BenchSummary& summary) {
  constexpr int kWidth_cells = 160;
  constexpr int kHeight_cells = 200;
  constexpr int kSides[] = {1, 2, 4, 6};
  const std::vector<RegisteredPlanner> planners = PlannerRegistry();
  for (const int side : kSides) {
    std::vector<Row> rows(planners.size());
    std::vector<double> information_ms;
    std::vector<double> reachable_cells;
    for (int i = 0; i < worlds; ++i) {
      const std::uint64_t seed = summary.seed() + static_cast<std::uint64_t>(i);
      PLUMESCOUT_ASSIGN_OR_RETURN(
          RandomWorld world,
          MakeKnownBuilding(side * kWidth_cells, side * kHeight_cells, seed, kGoals));
      const PlanCase c(std::move(world));
      const auto& reachable = c.reachable.values();
      reachable_cells.push_back(static_cast<double>(
          reachable.size() - std::count(reachable.begin(), reachable.end(), 0)));
      const Grid<double> d8 = OracleCosts(c.cost, c.start_cell, 8);
      PathResult result;
      for (std::size_t k = 0; k < planners.size(); ++k) {
        if (planners[k].is_rival) continue;
        rows[k].cpu_ms.push_back(MedianCpu_ms(1, [&] {
          result = planners[k].planner->FindPaths(c.Problem(seed, kNeverStop, planners[k].cost));
        }));
        rows[k].Add(result, c, d8, nullptr);
      }
      information_ms.push_back(MedianCpu_ms(3, [&] {
        ExpectedInformation information(c.world.belief);
        for (const auto& path : result.paths) {
          if (!path) continue;
          information.Of(ReadingCells(path->vertices, c.cost.geometry(), PlanningOptions{}));
        }
      }));
    }
    const std::string size = absl::StrCat("_", 16 * side, "x", 20 * side, "m");
    for (std::size_t k = 0; k < planners.size(); ++k) {
      if (!planners[k].is_rival) rows[k].Set(planners[k].name + size, summary);
    }
    summary.Set(absl::StrCat("expected_information_5", size, "_ms"), Median(information_ms));
    summary.Set(absl::StrCat("reachable_cells", size), Median(reachable_cells));
  }
  return absl::OkStatus();
}

// What figures are promised as, beside the names that they are measured under. A building of
// 96 x 120 m has some 909,000 reachable cells.
void SetPromised(BenchSummary& summary) {
  constexpr std::pair<const char*, const char*> kPromised[] = {
      {"xit300_ms", "xit_300_ms"},
      {"xit300_reached_ratio", "xit_300_reached_ratio"},
      {"xit300_tree_only_reached_ratio", "xit_300_tree_only_reached_ratio"},
      {"xit300_over_d32", "xit_300_over_d32"},
      {"exact_ms", "grid_exact_ms"},
      {"exact_over_d32", "grid_exact_over_d32"},
      {"anytime20_over_d32", "anytime_xit_20ms_over_d32"},
      {"default_909k_ms", "xit_300_96x120m_ms"},
      {"whatif_909k_ms", "expected_information_5_96x120m_ms"},
      {"whatif_candidates_ms", "expected_information_5_16x20m_ms"},
      {"ompl_best_equal_cost_over_ours_cpu_ratio", "rivals_no_dearer_over_grid_exact_ms_ratio"},
  };
  const auto figures = summary.summary().figures;
  for (const auto& [promised, measured] : kPromised) {
    for (const auto& [name, value] : figures) {
      if (name == measured) summary.Set(promised, value);
    }
  }
}

absl::Status Measure(int worlds, int buildings, BenchSummary& summary) {
  PLUMESCOUT_RETURN_IF_ERROR(MeasureMissions("", summary));
  summary.Set("worlds", worlds);
  PLUMESCOUT_RETURN_IF_ERROR(MeasureWholePlans(worlds, summary));
  MeasureAnytime(worlds, summary);
  MeasureStopsByWall(worlds, summary);
  PLUMESCOUT_RETURN_IF_ERROR(MeasureScaling(buildings, summary));
  MeasureRegistry(worlds, summary);
  PLUMESCOUT_RETURN_IF_ERROR(MeasureTeams(summary));
  SetPromised(summary);
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  int worlds = 50;
  int buildings = 6;
  std::string mission;
  bool teams = false;
  return plumescout::lab::BenchProgram(
             "Every planner on the same worlds: CPU time, goals reached, price over exact searches")
      .AddCount("--worlds", worlds, "Random halls")
      .AddCount("--buildings", buildings, "Large buildings of each size")
      .AddText("--mission", mission, "Only whole plans of this mission, as 16x20m")
      .AddSwitch("--teams", teams, "Only plans for whole teams")
      .Run(argc, argv, [&](plumescout::lab::BenchSummary& summary) {
        if (teams) return plumescout::lab::MeasureTeams(summary);
        if (!mission.empty()) return plumescout::lab::MeasureMissions(mission, summary);
        return plumescout::lab::Measure(worlds, buildings, summary);
      });
}
