// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/mit_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plan/cost/edge_cost.h"
#include "core/plan/paths/xit.h"
#include "core/plan/strategy.h"
#include "core/types/rng.h"
#include "lab/worlds/synthetic_scene.h"
#include "ompl_planners/ompl_planner.h"

namespace plumescout::lab {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// [MIT] section IV: the strategy's search, bare, with that share of even samples.
PlanningOptions Mit(double uniform_share) {
  PlanningOptions options;
  options.strategy = "mit";
  if (!ApplyStrategyRow(options).ok()) return {};
  options.sample_count = kMitSamples;
  options.max_connection_radius_m = 0.0;
  options.uniform_share = uniform_share;
  return options;
}

std::unique_ptr<const PathPlanner> MitSearch(double uniform_share) {
  return std::make_unique<const XitPlanner>(Mit(uniform_share));
}

std::unique_ptr<const PathPlanner> Tree(PathKind kind) {
  constexpr double kStep_m = 0.8;    // for kMitSamples draws on average
  constexpr int kPatience = 20'000;  // draws; no run came near
  return MakeRegionTreePlanner({kind, kStep_m, kGoalRadius_m, kPatience});
}

// Eq. (3): the mean over the cells of the path, each by the length of the path inside it.
double Psi(const InformationMap& information, const std::vector<Point2>& path) {
  double sum = 0.0;
  double length_cells = 0.0;
  const double resolution_m = information.value.geometry().resolution_m;
  for (std::size_t i = 1; i < path.size(); ++i) {
    sum += SegmentIntegral_cells(information.value, path[i - 1], path[i]);
    length_cells += Distance_m(path[i - 1], path[i]) / resolution_m;
  }
  return sum / length_cells;
}

MitRun Judge(const PathResult& result, const MitScene& scene) {
  MitRun run;
  run.samples = result.effort.samples;
  for (std::size_t i = 0; i < kTrajectories; ++i) {
    run.length_m[i] = kNan;
    run.psi[i] = kNan;
    if (!result.paths[i]) continue;
    run.paths[i] = result.paths[i]->vertices;
    run.length_m[i] = PathLength_m(run.paths[i]);
    run.psi[i] = Psi(scene.information, run.paths[i]);
    const bool better = run.best < 0 || run.psi[i] > run.psi[static_cast<std::size_t>(run.best)];
    if (better) run.best = static_cast<int>(i);
  }
  return run;
}

// Points of a path at equal shares of its length.
std::vector<Point2> Resample(const std::vector<Point2>& path) {
  constexpr int kPoints = 32;
  const double length_m = PathLength_m(path);
  std::vector<Point2> points;
  std::size_t segment = 0;
  double before_m = 0.0;  // length of the segments passed
  for (int k = 0; k < kPoints; ++k) {
    const double at_m = length_m * k / (kPoints - 1);
    double inside_m = Distance_m(path[segment], path[segment + 1]);
    while (segment + 2 < path.size() && before_m + inside_m < at_m) {
      before_m += inside_m;
      ++segment;
      inside_m = Distance_m(path[segment], path[segment + 1]);
    }
    const double share = inside_m > 0.0 ? std::min(1.0, (at_m - before_m) / inside_m) : 0.0;
    const Point2 a = path[segment];
    const Point2 b = path[segment + 1];
    points.push_back({a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m)});
  }
  return points;
}

}  // namespace

std::vector<MitRival> MitRivals(const MitScene& scene) {
  std::vector<MitRival> rivals;
  rivals.push_back({"MIT", MitSearch(scene.ucb_uniform_share), {21.6, 8.8, 69.6}});
  rivals.push_back({"RRT", Tree(PathKind::kRrt), {6.4, 56.0, 37.6}});
  rivals.push_back({"RRT*", Tree(PathKind::kRrtStar), {12.0, 47.6, 40.4}});
  rivals.push_back({"MIT, even draw", MitSearch(1.0), {kNan, kNan, kNan}});
  rivals.push_back({"MIT, by I-hat", MitSearch(0.0), {kNan, kNan, kNan}});
  return rivals;
}

std::vector<MitRun> RunMitRival(const MitRival& rival, const MitScene& scene, int runs,
                                std::uint64_t seed, const std::function<void()>& done) {
  const EdgeCost length(scene.information, CostKind::kEuclidean, 0.0);
  const StopFn stop = NeverStop();
  Rng seeds(seed);
  std::vector<MitRun> results;
  for (int i = 0; i < runs; ++i) {
    results.push_back(Judge(rival.planner->FindPaths({length, scene.reachable, scene.start,
                                                      scene.goals, seeds.Next(), 0, stop}),
                            scene));
    if (done) done();
  }
  return results;
}

MitSummary Summarise(const std::vector<MitRun>& runs) {
  MitSummary summary;
  summary.runs = static_cast<int>(runs.size());
  int with_path = 0;
  for (const MitRun& run : runs) {
    summary.samples += run.samples;
    if (run.best >= 0) {
      const auto best = static_cast<std::size_t>(run.best);
      ++summary.best[best];
      summary.chosen_psi += run.psi[best];
      ++with_path;
    }
    for (std::size_t i = 0; i < kTrajectories; ++i) {
      if (run.paths[i].empty()) continue;
      ++summary.found[i];
      summary.psi[i] += run.psi[i];
      summary.length_m[i] += run.length_m[i];
    }
  }
  summary.samples /= static_cast<double>(runs.size());
  summary.chosen_psi = with_path > 0 ? summary.chosen_psi / with_path : kNan;
  for (std::size_t i = 0; i < kTrajectories; ++i) {
    const double scale = summary.found[i] > 0 ? 1.0 / summary.found[i] : kNan;
    summary.psi[i] *= scale;
    summary.length_m[i] *= scale;
  }
  return summary;
}

int MostTypical(const std::vector<const std::vector<Point2>*>& paths) {
  std::vector<std::vector<Point2>> points;
  for (const auto* path : paths) {
    points.push_back(path->size() > 1 ? Resample(*path) : std::vector<Point2>{});
  }
  int typical = -1;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].empty()) continue;
    double sum_m = 0.0;
    for (const std::vector<Point2>& other : points) {
      for (std::size_t k = 0; k < other.size(); ++k) sum_m += Distance_m(points[i][k], other[k]);
    }
    if (sum_m < least_m) {
      least_m = sum_m;
      typical = static_cast<int>(i);
    }
  }
  return typical;
}

}  // namespace plumescout::lab
