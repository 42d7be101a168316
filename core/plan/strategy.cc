// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/strategy.h"

#include <algorithm>
#include <array>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/plan/composed_strategy.h"
#include "core/plan/paths/path_planners.h"
#include "core/plan/sampling/reward.h"
#include "core/plan/sampling/sampling_rule.h"
#include "core/plan/sampling/site_lattice.h"
#include "core/plan/sampling/survey.h"
#include "core/plan/sampling_strategy.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Which rule chooses the sites, of strategies that stop and sample.
enum class SiteRule { kNone, kReward, kLowToHigh, kRandom, kSweep };

// What a name of the strategy table stands for.
struct StrategyRow {
  absl::string_view name;
  GoalPolicy goal_policy = GoalPolicy::kGasFirst;
  PathKind paths = PathKind::kXit;
  CostKind cost = CostKind::kUcb;
  SelectionRule selection_rule = SelectionRule::kLeastCost;
  SiteRule sites = SiteRule::kNone;
};

constexpr StrategyRow SamplingRow(absl::string_view name, SiteRule rule) {
  return {name,
          GoalPolicy::kGasFirst,
          PathKind::kGridExact,
          CostKind::kEuclidean,
          SelectionRule::kLeastCost,
          rule};
}

constexpr std::array<StrategyRow, 10> kRows = {{
    {"xit_gff", GoalPolicy::kGasFirst},
    {"xit_fgf", GoalPolicy::kOccupancyFirst},
    {"xit_f", GoalPolicy::kOccupancyOnly},
    {"mit", GoalPolicy::kOccupancyOnly, PathKind::kXit, CostKind::kEuclidean,
     SelectionRule::kMeanUcb},
    {"rrt_star_frontier", GoalPolicy::kOccupancyOnly, PathKind::kRrtStar, CostKind::kEuclidean,
     SelectionRule::kLeastCost},
    {"plumescout", GoalPolicy::kEverything, PathKind::kXit, CostKind::kUcb,
     SelectionRule::kInformationRate},
    SamplingRow("ipp_reward", SiteRule::kReward),
    SamplingRow("lhr", SiteRule::kLowToHigh),
    SamplingRow("random_sampling", SiteRule::kRandom),
    SamplingRow("sweep", SiteRule::kSweep),
}};

// The search of [MIT] section IV, within ours: independent samples of the information map alone.
void ApplyMit(PlanningOptions& options) {
  constexpr int kSamples = 270;
  options.sample_count = kSamples;
  options.nearest_sample_count = 3;
  options.beta = 1.0;  // lambda
  options.sampling = SamplingKind::kIid;
  options.uniform_share = 0.0;
  options.goal_vertices = false;
}

std::unique_ptr<const SamplingRule> MakeRule(SiteRule rule) {
  switch (rule) {
    case SiteRule::kNone:
    case SiteRule::kReward:
      break;
    case SiteRule::kLowToHigh:
      return MakeLowToHighRule(/*at_random=*/false);
    case SiteRule::kRandom:
      return MakeLowToHighRule(/*at_random=*/true);
    case SiteRule::kSweep:
      return MakeSweepRule();
  }
  return MakeRewardRule();
}

// [LHR] Remark 1: T t_sam + T d_res / V <= t_up.
absl::Status CheckCycle(const PlanningOptions& options) {
  const SiteOptions& sites = options.sites;
  const double least_s =
      sites.cycle_sample_count * (options.dwell_s + sites.spacing_m / options.speed_mps);
  if (least_s <= sites.update_period_s) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      "planning.sites.update_period_s = ", sites.update_period_s, " must be at least ", least_s,
      ": T t_sam + T d_res / V <= t_up of Remark 1 in the LHR paper, with T = ",
      sites.cycle_sample_count, ", t_sam = ", options.dwell_s, " s, d_res = ", sites.spacing_m,
      " m and V = ", options.speed_mps, " m/s"));
}

absl::Status CheckRegion(const PlanningOptions& options, SiteRule rule) {
  const SiteOptions& sites = options.sites;
  if (!sites.region) {
    if (rule == SiteRule::kReward) return absl::OkStatus();  // its sites cover the map
    return absl::InvalidArgumentError(absl::StrCat(
        "planning.sites.region must be set for planning.strategy = \"", options.strategy, "\""));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const SiteLattice lattice,
                              MakeSiteLattice(*sites.region, sites.spacing_m));
  const bool has_survey = rule == SiteRule::kLowToHigh || rule == SiteRule::kRandom;
  if (has_survey && sites.survey) {
    return CheckSurvey(lattice, sites.survey_stride);
  }
  return absl::OkStatus();
}

absl::StatusOr<std::unique_ptr<const Strategy>> MakeSamplingStrategy(
    const PlanningOptions& options, SiteRule rule, std::unique_ptr<const PathPlanner> paths) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckRegion(options, rule));
  const bool has_cycles = rule == SiteRule::kLowToHigh || rule == SiteRule::kRandom;
  if (has_cycles) PLUMESCOUT_RETURN_IF_ERROR(CheckCycle(options));
  if (rule == SiteRule::kLowToHigh && IsPerTime(options.sites.reward)) {
    return absl::InvalidArgumentError(
        "planning.sites.reward is per time, which planning.strategy = \"lhr\" cannot add up");
  }
  PlanningOptions home = options;
  home.dwell_s = 0.0;  // nothing is sampled on the way
  return std::make_unique<const SamplingStrategy>(
      options, MakeRule(rule), std::make_unique<const ComposedStrategy>(home, std::move(paths)));
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

bool StopsAtSites(const std::string& strategy) {
  const auto row = FindRow(strategy);
  return row.ok() && row->sites != SiteRule::kNone;
}

absl::Status ApplyStrategyRow(PlanningOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const StrategyRow row, FindRow(options.strategy));
  options.goal_policy = row.goal_policy;
  options.paths = row.paths;
  options.cost = row.cost;
  options.selection_cost = row.cost;
  options.selection_rule = row.selection_rule;
  // Baselines drive the paths that they find; goals that they miss are completed like everybody's.
  options.straighten = row.cost == CostKind::kUcb;
  if (row.name == "mit") ApplyMit(options);
  if (row.sites == SiteRule::kReward) {
    options.sites.reward = SamplingReward::kConcentrationVariancePerTime;
  } else if (row.sites == SiteRule::kLowToHigh) {
    options.sites.reward = SamplingReward::kUcb;
  }
  return absl::OkStatus();
}

bool SamplesOnce(const PlanningOptions& options) {
  const auto row = FindRow(options.strategy);
  if (!row.ok() || row->sites == SiteRule::kNone) return false;
  return row->sites != SiteRule::kReward ||
         options.sites.reward == SamplingReward::kConcentrationPerTime;
}

absl::StatusOr<std::unique_ptr<const Strategy>> MakeStrategy(const PlanningOptions& options,
                                                             const PathPlannerFactory& others) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto paths, MakePathPlanner(options, others));
  return MakeStrategyWith(options, std::move(paths));
}

absl::StatusOr<std::unique_ptr<const Strategy>> MakeStrategyWith(
    const PlanningOptions& options, std::unique_ptr<const PathPlanner> paths) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const StrategyRow row, FindRow(options.strategy));
  if (row.sites != SiteRule::kNone) {
    return MakeSamplingStrategy(options, row.sites, std::move(paths));
  }
  return std::make_unique<const ComposedStrategy>(options, std::move(paths));
}

}  // namespace plumescout
