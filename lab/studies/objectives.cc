// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/objectives.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/time.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/formats/scene_folder.h"
#include "lab/local/local_planner_client.h"
#include "lab/sim/episode.h"
#include "lab/sim/scene_world.h"
#include "lab/studies/objective_truth.h"
#include "lab/trials/calibration_table.h"
#include "lab/trials/map_calibration.h"
#include "lab/trials/statistics.h"
#include "lab/trials/study.h"
#include "lab/trials/study_scenes.h"
#include "lab/trials/task_pool.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {
namespace {

constexpr std::uint64_t kFirstBuilding = 762;       // 730 to 733 were tuned on
constexpr std::uint64_t kFirstQuickBuilding = 730;  // a first look leaves the others unseen
constexpr int kBuildings = 8;
constexpr double kDuration_s = 600.0;
constexpr double kQuickDuration_s = 30.0;
constexpr double kThreshold_ppm = 10.0;
constexpr double kDeadline_s = 120.0;
constexpr double kHomeReach_m = 0.5;

// A mission of every row is driven in every building.
struct Row {
  const char* name;
  const char* label;
  ObjectiveKind kind;
  bool clean;  // nothing leaks
  double deadline_s = 0.0;
};
constexpr std::size_t kCompleteGas = 0;
constexpr std::size_t kCompleteClean = 4;
constexpr Row kRows[] = {
    {"complete_map", "complete map, leak", ObjectiveKind::kCompleteMap, false},
    {"map_above_threshold", "map above 10 ppm, leak", ObjectiveKind::kMapAboveThreshold, false},
    {"find_sources", "find sources, leak", ObjectiveKind::kFindSources, false},
    {"confirm_clean", "confirm clean, leak", ObjectiveKind::kConfirmClean, false},
    {"complete_map_clean", "complete map, clean", ObjectiveKind::kCompleteMap, true},
    {"confirm_clean_clean", "confirm clean, clean", ObjectiveKind::kConfirmClean, true},
    {"find_sources_clean", "find sources, clean", ObjectiveKind::kFindSources, true},
    {"deadline", "complete map, leak, 120 s", ObjectiveKind::kCompleteMap, false, kDeadline_s},
};
constexpr std::size_t kRowCount = std::size(kRows);

struct Outcome {
  double stopped_s = 0.0;
  bool completed = false;
  std::optional<ObjectiveStatus> status = std::nullopt;
  ObjectiveTruth truth = {};  // of a mission with an objective
  MapCalibration calibration = {};
  double home_m = 0.0;  // from where it began, at the end
};

Scene WithoutGas(Scene scene) {
  const auto clear = [](Grid<float>& grid) {
    std::fill(grid.values().begin(), grid.values().end(), 0.0F);
  };
  clear(scene.conc_mean_ppm);
  clear(scene.conc_std_ppm);
  for (Grid<float>& grid : scene.conc_mean_by_source_ppm) clear(grid);
  std::fill(scene.series.counts.begin(), scene.series.counts.end(), std::uint16_t{0});
  return scene;
}

absl::StatusOr<Outcome> Drive(const SceneWorld& world, const Row& row, std::uint64_t seed,
                              double duration_s) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const StudyRow strategy,
                              MakeStudyRow("plumescout", "plumescout", false));
  LocalPlannerClient planner;
  EpisodeOptions options;
  options.mission = "objective";
  options.create = strategy.mission;
  options.create->seed = seed;
  options.create->gas = GasOptions{};          // what is promised is by the variances told
  options.create->gas.refresh_period_s = 1.0;  // as often as objectives are assessed
  options.mission_corrects_lag = true;
  options.end_margin_m = kStudiedEndMargin_m;
  options.create->objective = {
      .kind = row.kind, .threshold_ppm = kThreshold_ppm, .deadline_s = row.deadline_s};
  options.duration_s = duration_s;
  options.metrics_period_s = duration_s;
  options.plan_budget = absl::InfiniteDuration();
  options.simulated.seed = seed;
  PLUMESCOUT_ASSIGN_OR_RETURN(const EpisodeResult ran, RunEpisode(planner, world, options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto belief, planner.GetBelief(options.mission));
  Outcome outcome{.stopped_s = ran.simulated_s, .completed = ran.completed};
  outcome.status = belief->objective;
  if (belief->objective) outcome.truth = CompareWithTruth(*belief, world.scene());
  outcome.calibration =
      Calibrate(world.scene(), *belief->gas_mean_ppm, *belief->Gas(0).published_variance_ppm2());
  outcome.home_m = Distance_m(ran.path.front().pose.position(), ran.path.back().pose.position());
  return outcome;
}

struct Building {
  std::string name;
  std::vector<Outcome> rows;
};

absl::StatusOr<std::vector<Building>> DriveAll(const ExperimentOptions& options,
                                               const std::vector<std::string>& scenes,
                                               const std::function<void(double)>& progress) {
  const double duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  std::vector<Building> buildings;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Scene scene, ReadScene(scenes[s]));
    const SceneWorld clean(WithoutGas(scene));
    const SceneWorld gas(std::move(scene));
    Building& building = buildings.emplace_back();
    building.name = SceneName(scenes[s]);
    building.rows.resize(kRowCount);
    const auto run = [&](std::size_t row) -> absl::Status {
      PLUMESCOUT_ASSIGN_OR_RETURN(building.rows[row], Drive(kRows[row].clean ? clean : gas,
                                                            kRows[row], options.seed, duration_s));
      return absl::OkStatus();
    };
    PLUMESCOUT_RETURN_IF_ERROR(RunTasks(kRowCount, options.jobs, run, [&](double share) {
      progress((static_cast<double>(s) + share) / static_cast<double>(scenes.size()));
    }));
  }
  return buildings;
}

std::vector<double> Of(const std::vector<Building>& buildings, std::size_t row,
                       const std::function<double(const Outcome&)>& figure) {
  std::vector<double> values;
  for (const Building& building : buildings) values.push_back(figure(building.rows[row]));
  return values;
}

int CountIf(const std::vector<Building>& buildings, std::size_t row,
            const std::function<bool(const Outcome&)>& holds) {
  return static_cast<int>(
      std::count_if(buildings.begin(), buildings.end(),
                    [&](const Building& building) { return holds(building.rows[row]); }));
}

bool Is(const Outcome& outcome, ObjectiveState state) {
  return outcome.status && outcome.status->state == state;
}
bool IsSaid(const Outcome& outcome) { return outcome.status && IsConcluded(*outcome.status); }

// What it took of the time of a complete map of the same building.
double TimeShare(const Building& building, std::size_t row) {
  const std::size_t whole = kRows[row].clean ? kCompleteClean : kCompleteGas;
  return building.rows[row].stopped_s / building.rows[whole].stopped_s;
}

std::vector<std::string> TableRow(const std::vector<Building>& buildings, std::size_t row,
                                  Summary& summary) {
  const int met =
      CountIf(buildings, row, [](const auto& o) { return Is(o, ObjectiveState::kMet); });
  const int said = CountIf(buildings, row, IsSaid);
  const int right = CountIf(buildings, row, [](const auto& o) { return o.truth.is_right; });
  const Spread time_s = SpreadOf(Of(buildings, row, [](const auto& o) { return o.stopped_s; }));
  std::vector<double> shares;
  for (const Building& building : buildings) shares.push_back(TimeShare(building, row));
  const Spread share = SpreadOf(shares);
  const Spread rmse_ppm =
      SpreadOf(Of(buildings, row, [](const auto& o) { return o.calibration.rmse_ppm; }));
  const Spread cells =
      SpreadOf(Of(buildings, row, [](const auto& o) { return o.truth.right_share; }));
  const bool has_objective = kRows[row].kind != ObjectiveKind::kCompleteMap;
  const auto add = [&](const char* name, double value) {
    summary.figures.emplace_back(absl::StrCat(kRows[row].name, "_", name), value);
  };
  add("stopped_s", time_s.mean);
  add("time_share", share.mean);
  if (!kRows[row].clean) add("rmse_ppm", rmse_ppm.mean);
  if (has_objective) {
    add("met", met);
    add("refuted", said - met);
    add("right", right);
    add("right_cells", cells.mean);
  }
  const int home = CountIf(buildings, row, [](const auto& o) { return o.home_m <= kHomeReach_m; });
  if (kRows[row].deadline_s > 0.0) add("home", home);
  const auto if_objective = [&](std::string text) { return has_objective ? text : "–"; };
  return {kRows[row].label,
          absl::StrFormat("%.0f [± %.0f]", time_s.mean, time_s.half_95),
          absl::StrFormat("%.2f [± %.2f]", share.mean, share.half_95),
          if_objective(absl::StrCat(met)),
          if_objective(absl::StrCat(said - met)),
          if_objective(said == 0 ? "–" : absl::StrFormat("%d of %d", right, said)),
          if_objective(absl::StrFormat("%.3f", cells.mean)),
          kRows[row].clean ? "–" : absl::StrFormat("%.2f", rmse_ppm.mean),
          kRows[row].deadline_s > 0.0 ? absl::StrCat(home) : "–"};
}

TextTable MakeTable(const std::vector<Building>& buildings, Summary& summary) {
  TextTable table;
  table.title = absl::StrFormat("%d buildings, one mission each", buildings.size());
  table.columns = {"mission",
                   "stops after, s",
                   "share of a complete map's time",
                   "met",
                   "refuted",
                   "what was said is so",
                   "decided cells that are so",
                   "RMSE, critical cells, ppm",
                   "home at the end"};
  for (std::size_t row = 0; row < kRowCount; ++row) {
    table.rows.push_back(TableRow(buildings, row, summary));
  }
  return table;
}

BarChart MakeTimeChart(const std::vector<Building>& buildings) {
  constexpr Rgb kColors[] = {{36, 99, 201},   {206, 30, 60},  {20, 130, 90}, {225, 140, 40},
                             {130, 170, 225}, {120, 70, 160}, {90, 90, 90},  {180, 150, 60}};
  static_assert(std::size(kColors) == kRowCount);
  BarChart chart;
  chart.title = "When missions stop, s";
  chart.x_label = "building";
  for (const Building& building : buildings) chart.groups.push_back(building.name);
  for (std::size_t row = 0; row < kRowCount; ++row) {
    BarSeries& series = chart.series.emplace_back();
    series.name = kRows[row].label;
    series.color = kColors[row];
    for (const Building& building : buildings) {
      series.bars.push_back({.value = building.rows[row].stopped_s});
    }
  }
  return chart;
}

// Of missions where something leaks.
std::vector<RowMaps> FinalMaps(const std::vector<Building>& buildings) {
  std::vector<RowMaps> rows;
  for (std::size_t row = 0; row < kRowCount; ++row) {
    if (kRows[row].clean) continue;
    RowMaps& of_row = rows.emplace_back(RowMaps{kRows[row].name, {}});
    for (const Building& building : buildings) {
      of_row.maps.push_back(building.rows[row].calibration);
    }
  }
  return rows;
}

CsvTable MakeCsv(const std::vector<Building>& buildings) {
  CsvTable csv;
  csv.label_columns = {"building", "mission", "explanation"};
  csv.columns = {"stopped_s",         "completed",      "state",    "confidence",
                 "undecided_area_m2", "open_frontiers", "is_right", "right_share",
                 "decided_cells",     "greatest_ppm",   "rmse_ppm", "home_m"};
  AddCalibrationColumns(csv);
  for (const Building& building : buildings) {
    for (std::size_t row = 0; row < kRowCount; ++row) {
      const Outcome& o = building.rows[row];
      const ObjectiveStatus status = o.status.value_or(ObjectiveStatus());
      const ObjectiveOptions told = {.kind = kRows[row].kind, .threshold_ppm = kThreshold_ppm};
      csv.labels.push_back(
          {building.name, kRows[row].name, o.status ? Describe(status, told) : ""});
      csv.rows.push_back({o.stopped_s, o.completed ? 1.0 : 0.0,
                          o.status ? static_cast<double>(status.state) : -1.0, status.confidence,
                          status.undecided_area_m2, static_cast<double>(status.open_frontiers),
                          o.truth.is_right ? 1.0 : 0.0, o.truth.right_share, o.truth.decided_cells,
                          o.truth.greatest_ppm, o.calibration.rmse_ppm, o.home_m});
      AddCalibration(o.calibration, csv.rows.back());
    }
  }
  return csv;
}

}  // namespace

absl::StatusOr<Study> RunObjectives(const ExperimentOptions& options) {
  constexpr double kScenesShare = 0.3;  // of the time, for the progress line
  ExperimentOptions making = options;
  making.progress = PartOfProgress(options, 0.0, kScenesShare);
  const double duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<std::string> scenes,
                              GeneratedScenes(making,
                                              {options.quick ? kFirstQuickBuilding : kFirstBuilding,
                                               options.quick ? 1 : kBuildings},
                                              duration_s));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const std::vector<Building> buildings,
      DriveAll(options, scenes, PartOfProgress(options, kScenesShare, 1.0)));
  Study study;
  study.figures.title = "Missions that know what they are for";
  study.figures.notes = {
      absl::StrFormat("Missions of at most %.0f s by the default strategy, with a threshold of %g "
                      "ppm and a confidence of 95 %%. The truth is the mean over time.",
                      duration_s, kThreshold_ppm),
      "Clean: the same building, and nothing leaks. So is: see objective_truth.h. The confidence "
      "is "
      "promised of each cell, not of all of them at once."};
  study.figures.tables = {MakeTable(buildings, study.summary)};
  AddCalibration(FinalMaps(buildings), study);
  study.figures.bar_charts = {MakeTimeChart(buildings)};
  study.table = MakeCsv(buildings);
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
