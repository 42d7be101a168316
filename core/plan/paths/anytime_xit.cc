// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/anytime_xit.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "core/plan/paths/guarded_planner.h"
#include "core/plan/paths/xit.h"
#include "core/types/rng.h"

namespace plumescout {
namespace {

constexpr int kPatience = 2;           // batches without gain
constexpr int kMostSamples = 100'000;  // as PlanningOptions::sample_count

// What a batch added to the best answer so far.
struct Gain {
  bool any = false;    // some path is new or cheaper
  bool worth = false;  // by kLeastGain
};

Gain Keep(PathResult found, PathResult& best) {
  Gain gain;
  for (std::size_t i = 0; i < best.paths.size(); ++i) {
    std::optional<FoundPath>& known = best.paths[i];
    std::optional<FoundPath>& path = found.paths[i];
    if (!path || (known && path->cost >= known->cost)) continue;
    gain.any = true;
    gain.worth =
        gain.worth || !known || path->cost < known->cost * (1.0 - AnytimeXitPlanner::kLeastGain);
    known = std::move(path);
  }
  best.effort.samples += found.effort.samples;
  best.effort.vertices += found.effort.vertices;
  best.effort.edges_evaluated += found.effort.edges_evaluated;
  ++best.effort.batches;
  return gain;
}

// Whether a goal has no path though it is connected to the start.
bool MissesAGoal(const PathProblem& problem, const PathResult& result) {
  for (std::size_t i = 0; i < result.paths.size(); ++i) {
    if (!result.paths[i] && problem.reachable.At(problem.goals[i].cell, 0) != 0) return true;
  }
  return false;
}

void Conclude(bool stopped, PathResult& best) {
  for (const std::optional<FoundPath>& path : best.paths) {
    if (path && path->source == PathSource::kGridGuard) ++best.effort.goals_by_guard;
  }
  best.end = EndOf(best.paths, stopped);
}

}  // namespace

PathResult AnytimeXitPlanner::FindPaths(const PathProblem& problem) const {
  PathResult best;
  best.paths.resize(problem.goals.size());
  Rng seeds(problem.seed);
  const auto cells = std::count(problem.reachable.values().begin(),
                                problem.reachable.values().end(), std::uint8_t{1});
  bool stopped = false;
  int without_gain = 0;
  for (int samples = kFirstBatch; !stopped && without_gain < kPatience; samples *= 2) {
    PathProblem batch = problem;
    batch.seed = seeds.Next();
    if (problem.max_edge_evaluations > 0) {
      batch.max_edge_evaluations = problem.max_edge_evaluations - best.effort.edges_evaluated;
    }
    const Gain gain = Keep(SearchBatch(batch, samples), best);
    if (gain.any && problem.improved != nullptr) (*problem.improved)(best);
    const bool spent = problem.max_edge_evaluations > 0 &&
                       best.effort.edges_evaluated >= problem.max_edge_evaluations;
    stopped = spent || problem.stop();
    // While the tree may yet find a missed goal, more samples are worth their time.
    without_gain = gain.worth || MissesAGoal(problem, best) ? 0 : without_gain + 1;
    if (samples >= std::min<std::int64_t>(cells, kMostSamples / 2)) break;
  }
  Conclude(stopped, best);
  return best;
}

PathResult AnytimeXitPlanner::SearchBatch(const PathProblem& problem, int samples) const {
  PlanningOptions options = options_;
  options.sample_count = samples;
  options.goal_vertices = true;
  return GuardedPlanner(std::make_unique<const XitPlanner>(options), options).FindPaths(problem);
}

}  // namespace plumescout
