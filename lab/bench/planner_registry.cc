// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/planner_registry.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/plan/paths/path_planners.h"
#include "core/plan/paths/xit.h"
#include "core/plan/strategy.h"
#include "ompl_planners/ompl_planner.h"

namespace plumescout::lab {
namespace {

// As published: independent samples, paths that end at neighbours of goals, nothing added.
PlanningOptions AsPublished(int samples) {
  PlanningOptions options;
  options.sample_count = samples;
  options.sampling = SamplingKind::kIid;
  options.goal_vertices = false;
  options.max_connection_radius_m = 0.0;
  return options;
}

PlanningOptions Mit() {
  PlanningOptions options;
  options.strategy = "mit";
  if (!ApplyStrategyRow(options).ok()) return {};
  options.max_connection_radius_m = 0.0;
  return options;
}

RegisteredPlanner Ours(std::string name, PathKind kind, int samples) {
  PlanningOptions options;
  options.paths = kind;
  options.sample_count = samples;
  return {std::move(name), *MakePathPlanner(options, nullptr)};
}

RegisteredPlanner Rival(PathKind kind, int samples) {
  PlanningOptions options;
  options.paths = kind;
  options.sample_count = samples;
  return {absl::StrCat(PathKindName(kind), "_", samples), MakeOmplPlanner(options), options.cost,
          true};
}

}  // namespace

std::vector<RegisteredPlanner> PlannerRegistry() {
  std::vector<RegisteredPlanner> planners;
  planners.push_back({"xit_300_published", std::make_unique<const XitPlanner>(AsPublished(300))});
  planners.push_back({"mit_270", std::make_unique<const XitPlanner>(Mit()), Mit().cost});
  planners.push_back(Ours("xit_300", PathKind::kXit, 300));
  PlanningOptions tree_only;
  tree_only.sample_count = 300;
  planners.push_back({"xit_300_tree_only", std::make_unique<const XitPlanner>(tree_only)});
  planners.push_back(Ours("xit_1000", PathKind::kXit, 1000));
  planners.push_back(Ours("grid_exact", PathKind::kGridExact, 1));
  planners.push_back(Ours("anytime_xit", PathKind::kAnytimeXit, 1));
  for (const int samples : {300, 1000}) {
    for (const PathKind kind : {PathKind::kRrt, PathKind::kRrtStar, PathKind::kInformedRrtStar,
                                PathKind::kBitStar, PathKind::kPrmStar}) {
      planners.push_back(Rival(kind, samples));
    }
  }
  planners.push_back(Rival(PathKind::kPrmStar, 3000));
  planners.push_back(Rival(PathKind::kPrmStar, 10'000));
  return planners;
}

}  // namespace plumescout::lab
