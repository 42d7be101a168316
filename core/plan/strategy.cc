// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/strategy.h"

#include <algorithm>
#include <array>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/plan/composed_strategy.h"
#include "core/plan/paths/path_planners.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// What a name of the strategy table stands for.
struct StrategyRow {
  absl::string_view name;
  GoalPolicy goals = GoalPolicy::kGasFirst;
  PathKind paths = PathKind::kXit;
  CostKind cost = CostKind::kUcb;
  SelectionRule selection = SelectionRule::kLeastCost;
};

constexpr std::array<StrategyRow, 6> kRows = {{
    {"xit_gff", GoalPolicy::kGasFirst},
    {"xit_fgf", GoalPolicy::kOccupancyFirst},
    {"xit_f", GoalPolicy::kOccupancyOnly},
    {"mit", GoalPolicy::kOccupancyOnly, PathKind::kXit, CostKind::kEuclidean,
     SelectionRule::kMeanUcb},
    {"rrt_star_frontier", GoalPolicy::kOccupancyOnly, PathKind::kRrtStar, CostKind::kEuclidean,
     SelectionRule::kLeastCost},
    {"plumescout", GoalPolicy::kEverything, PathKind::kXit, CostKind::kUcb,
     SelectionRule::kInformationRate},
}};

// The search of [MIT] section IV, within ours: independent samples of the UCB field alone.
void ApplyMit(PlanningOptions& options) {
  constexpr int kSamples = 270;
  options.samples = kSamples;
  options.nearest_samples = 3;
  options.beta = 1.0;  // lambda
  options.sampling = SamplingKind::kIid;
  options.uniform_share = 0.0;
  options.goal_vertices = false;
}

absl::StatusOr<StrategyRow> FindRow(const std::string& name) {
  const auto* row =
      std::find_if(kRows.begin(), kRows.end(), [&](const auto& r) { return r.name == name; });
  if (row != kRows.end()) return *row;
  return absl::InvalidArgumentError(absl::StrCat(
      "planning.strategy = \"", name, "\" must be one of ", absl::StrJoin(StrategyNames(), ", ")));
}

}  // namespace

std::vector<std::string> StrategyNames() {
  std::vector<std::string> names;
  for (const StrategyRow& row : kRows) names.emplace_back(row.name);
  return names;
}

absl::Status ApplyStrategyRow(PlanningOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const StrategyRow row, FindRow(options.strategy));
  options.goals = row.goals;
  options.paths = row.paths;
  options.cost = row.cost;
  options.selection_cost = row.cost;
  options.selection = row.selection;
  // Baselines drive the paths that they find; goals that they miss are completed like everybody's.
  options.straighten = row.cost == CostKind::kUcb;
  if (row.name == "mit") ApplyMit(options);
  return absl::OkStatus();
}

absl::StatusOr<std::unique_ptr<const Strategy>> MakeStrategy(const PlanningOptions& options,
                                                             const PathPlannerFactory& others) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  PLUMESCOUT_RETURN_IF_ERROR(FindRow(options.strategy).status());
  auto paths = MakePathPlanner(options, others);
  PLUMESCOUT_RETURN_IF_ERROR(paths.status());
  return std::make_unique<const ComposedStrategy>(options, *std::move(paths));
}

}  // namespace plumescout
