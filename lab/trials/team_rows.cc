// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_rows.h"

#include <cstddef>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "lab/worlds/one_lane_layout.h"

namespace plumescout::lab {
namespace {

absl::StatusOr<TrialPlan> MakePlan(const ExperimentOptions& options,
                                   const std::vector<TeamRow>& teams,
                                   std::vector<std::string> scenes) {
  TrialPlan plan;
  for (const TeamRow& team : teams) {
    PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow row, MakeStudyRow(team));
    plan.rows.push_back(std::move(row));
  }
  plan.scenes = std::move(scenes);
  plan.first_seed = options.seed;
  plan.folder = absl::StrCat(options.folder, "/trials");
  plan.jobs = options.jobs;
  return plan;
}

}  // namespace

absl::StatusOr<StudyRow> MakeStudyRow(const TeamRow& team) {
  const char* const strategy = team.rule ? "rrt_star_frontier" : "plumescout";
  PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow row,
                              MakeStudyRow(team.name, strategy, /*with_the_papers_goals=*/false));
  PlanningOptions& planning = row.mission.planning;
  if (team.rule) planning.paths = PathKind::kGridExact;
  planning.yield_to_robots = team.yields;
  planning.anticipate_robots = team.anticipates;
  planning.balanced_areas = team.balanced_areas;
  if (!team.rule) row.robot.replan_period_s = team.replan_period_s;
  row.robots = team.robots;
  row.most_late_s = team.most_late_s;
  row.ghosts = team.ghosts;
  row.rule = team.rule;
  return row;
}

absl::StatusOr<SizeResult> RunSize(const ExperimentOptions& options, const BuildingSize& size,
                                   std::vector<TeamRow> teams, double duration_s, int trials) {
  constexpr double kScenesShare = 0.2;  // of the time, for the progress line
  ExperimentOptions making = options;
  making.progress = PartOfProgress(options, 0.0, kScenesShare);
  GeneratedBuildings buildings = size.buildings;
  if (options.quick) buildings.count = 1;
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<std::string> scenes,
                              size.is_tight
                                  ? LayoutScenes(making, buildings, OneLaneLayout, duration_s)
                                  : GeneratedScenes(making, buildings, duration_s));
  SizeResult result{&size, std::move(teams), {}, {}};
  PLUMESCOUT_ASSIGN_OR_RETURN(result.plan, MakePlan(options, result.teams, std::move(scenes)));
  result.plan.trials = options.trials.value_or(trials);
  result.plan.duration_s = duration_s;
  result.plan.progress = PartOfProgress(options, kScenesShare, 1.0);
  PLUMESCOUT_ASSIGN_OR_RETURN(result.records, RunTrials(result.plan));
  return result;
}

absl::Status RunSizes(const ExperimentOptions& options, const std::vector<SizeToRun>& sizes,
                      const std::function<absl::Status(const SizeResult&)>& told) {
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double of_all = 1.0 / static_cast<double>(sizes.size());
    ExperimentOptions part = options;
    part.progress = [&options, i, of_all](double share) {
      if (options.progress) options.progress(of_all * (static_cast<double>(i) + share));
    };
    const SizeToRun& size = sizes[i];
    PLUMESCOUT_ASSIGN_OR_RETURN(const SizeResult result, RunSize(part, *size.size, size.teams,
                                                                 size.duration_s, size.trials));
    PLUMESCOUT_RETURN_IF_ERROR(told(result));
  }
  return absl::OkStatus();
}

}  // namespace plumescout::lab
