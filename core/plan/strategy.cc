// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/strategy.h"

#include <algorithm>
#include <array>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/plan/composed_strategy.h"
#include "core/plan/paths/xit.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// What a name of the strategy table stands for.
struct StrategyRow {
  absl::string_view name;
  GoalPolicy goals;
};

constexpr std::array<StrategyRow, 3> kRows = {{{"xit_gff", GoalPolicy::kGasFirst},
                                               {"xit_fgf", GoalPolicy::kOccupancyFirst},
                                               {"xit_f", GoalPolicy::kOccupancyOnly}}};

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
  options.cost = CostKind::kUcb;
  options.selection_cost = CostKind::kUcb;
  options.selection = SelectionRule::kLeastCost;
  return absl::OkStatus();
}

absl::StatusOr<std::unique_ptr<const Strategy>> MakeStrategy(const PlanningOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  PLUMESCOUT_RETURN_IF_ERROR(FindRow(options.strategy).status());
  return std::make_unique<const ComposedStrategy>(options,
                                                  std::make_unique<const XitPlanner>(options));
}

}  // namespace plumescout
