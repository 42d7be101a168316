// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/trial_study.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/plan/sampling/site_lattice.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "lab/formats/scene_folder.h"
#include "lab/sim/scene_world.h"
#include "lab/trials/task_pool.h"
#include "lab/trials/trial_store.h"

namespace plumescout::lab {
namespace {

std::vector<MissionOptions> MissionsIn(const TrialPlan& plan, const Scene& scene) {
  std::vector<MissionOptions> missions;
  for (const StudyRow& row : plan.rows) {
    MissionOptions& mission = missions.emplace_back(row.mission);
    if (row.knows_map) {
      mission.prior_map = std::make_shared<const Grid<CellState>>(scene.occupancy);
    }
    SiteOptions& sites = mission.planning.sites;
    if (row.samples_building) {
      sites.region = RegionOver(scene.geometry(), sites.spacing_m, sites.survey_stride);
    }
  }
  return missions;
}

// All trials in one building.
class SceneStudy {
 public:
  SceneStudy(const TrialPlan& plan, std::string name, Scene scene, const TrialStore& store)
      : plan_(plan),
        name_(std::move(name)),
        world_(std::move(scene)),
        scene_checksum_(SceneChecksum(world_.scene())),
        store_(store),
        missions_(MissionsIn(plan, world_.scene())),
        records_(plan.rows.size(),
                 std::vector<TrialRecord>(static_cast<std::size_t>(plan.trials))) {}

  std::size_t size() const { return plan_.rows.size() * static_cast<std::size_t>(plan_.trials); }

  // Safe to call for different tasks at once. All rows of a trial come before the next trial, so
  // that a study that is broken off has pairs.
  absl::Status Run(std::size_t task) {
    const std::size_t row = task % plan_.rows.size();
    const std::size_t number = task / plan_.rows.size();
    Trial trial;
    trial.mission = &missions_[row];
    trial.peer = plan_.peer;
    trial.world = &world_;
    trial.tells_other_entropies = plan_.tells_other_entropies;
    trial.robots = plan_.rows[row].robots;
    trial.robot = plan_.rows[row].robot;
    trial.most_late_s = plan_.rows[row].most_late_s;
    trial.ghosts = plan_.rows[row].ghosts;
    trial.rule = plan_.rows[row].rule;
    trial.second_field = plan_.rows[row].second_field;
    trial.seed = plan_.first_seed + number;
    trial.duration_s = plan_.duration_s;
    trial.map_times_s = plan_.map_times_s;
    const std::string file = absl::StrCat(name_, "-", plan_.rows[row].name, "-", trial.seed);
    const std::string fingerprint = Fingerprint(trial, scene_checksum_);
    TrialRecord& record = records_[row][number];
    std::optional<TrialRecord> kept = store_.Find(file, fingerprint, world_.scene().geometry());
    if (kept) {
      record = *std::move(kept);
      return absl::OkStatus();
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(record, RunTrial(trial));
    return store_.Keep(file, fingerprint, record);
  }

  SceneRecords records() && { return std::move(records_); }

 private:
  const TrialPlan& plan_;
  const std::string name_;
  const SceneWorld world_;
  const std::uint32_t scene_checksum_;
  const TrialStore& store_;
  const std::vector<MissionOptions> missions_;  // by row
  SceneRecords records_;
};

}  // namespace

absl::StatusOr<StudyRow> MakeStudyRow(const std::string& name, const std::string& strategy,
                                      bool with_the_papers_goals) {
  constexpr int kEndless = 1000;  // more fallbacks than a trial has time for
  StudyRow row{name, {}};
  PlanningOptions& planning = row.mission.planning;
  planning.strategy = strategy;
  PLUMESCOUT_RETURN_IF_ERROR(ApplyStrategyRow(planning));
  planning.fallback_limit = kEndless;
  planning.draw_goals = with_the_papers_goals;
  planning.fallback_to_unobserved = !with_the_papers_goals;
  if (with_the_papers_goals) planning.max_connection_radius_m = 0.0;
  // Rows are compared in maps and the field of [XIT], by the entropy of its own variances, as
  // papers are.
  row.mission.occupancy = PublishedOccupancyOptions();
  row.mission.gas = PublishedGasOptions();
  row.mission.gas.estimate_noise = false;
  return row;
}

StudyRow AsMissionsAre(StudyRow row) {
  row.mission.gas = GasOptions{};
  row.mission.occupancy = OccupancyOptions{};
  row.robot.leaves_lag_to_mission = true;
  return row;
}

absl::StatusOr<StudyRow> MakePublishedRow(const std::string& name, const std::string& strategy) {
  PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow row,
                              MakeStudyRow(name, strategy, /*with_the_papers_goals=*/true));
  PlanningOptions& planning = row.mission.planning;
  planning.sampling = SamplingKind::kIid;
  planning.raw_variance = true;
  planning.goal_vertices = false;
  planning.grid_guard = false;
  planning.straighten = false;
  row.mission.frontier.wgfd_scope = WgfdScope::kLocal;
  row.robot.corrects_gas_lag = false;
  return row;
}

std::string SceneName(const std::string& folder) {
  const std::filesystem::path path(folder);
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

absl::StatusOr<std::vector<SceneRecords>> RunTrials(const TrialPlan& plan) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const TrialStore store, TrialStore::Open(plan.folder));
  std::vector<SceneRecords> records;
  const auto scenes = static_cast<double>(plan.scenes.size());
  for (const std::string& folder : plan.scenes) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Scene scene, ReadScene(folder));
    SceneStudy study(plan, SceneName(folder), std::move(scene), store);
    const double before = static_cast<double>(records.size()) / scenes;
    PLUMESCOUT_RETURN_IF_ERROR(RunTasks(
        study.size(), plan.jobs, [&](std::size_t task) { return study.Run(task); },
        [&](double share) {
          if (plan.progress) plan.progress(before + share / scenes);
        }));
    records.push_back(std::move(study).records());
  }
  return records;
}

}  // namespace plumescout::lab
