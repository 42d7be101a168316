// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/all_strategies.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/trials/row_figures.h"
#include "lab/trials/study_scenes.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {
namespace {

// Not those of own_strategy, nor those that it was tuned in.
constexpr std::uint64_t kFirstBuilding = 201;
constexpr int kBuildings = 10;
constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 60.0;
constexpr double kPercent = 100.0;
constexpr double kScenesShare = 0.2;  // of the time, for the progress line

// Strategies that stop at sites do so every metre, for 2 s; the survey every third site. Their
// sensor reads on the way too, as everybody's.
constexpr double kSpacing_m = 1.0;
constexpr int kSurveyStride = 3;
constexpr double kDwell_s = 2.0;
// As wide as its authors take it for robots in rooms.
constexpr KernelDmvOptions kPeer{0.5, 1.0};

absl::StatusOr<StudyRow> MakeRow(const std::string& strategy, bool knows_map) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      StudyRow row,
      MakeStudyRow(absl::StrCat(strategy, knows_map ? "_known" : ""), strategy, false));
  row.knows_map = knows_map;
  row.samples_building = StopsAtSites(strategy);
  if (row.samples_building) {
    row.mission.planning.dwell_s = kDwell_s;
    row.mission.planning.sites.spacing_m = kSpacing_m;
    row.mission.planning.sites.survey_stride = kSurveyStride;
    row.mission.planning.sites.survey = strategy == "lhr";
  }
  return row;
}

absl::StatusOr<TrialPlan> MakePlan(const ExperimentOptions& options) {
  TrialPlan plan;
  for (const std::string& strategy : StrategyNames()) {
    for (const bool knows_map : {false, true}) {
      PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow row, MakeRow(strategy, knows_map));
      plan.rows.push_back(std::move(row));
    }
  }
  plan.duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  ExperimentOptions making = options;
  making.progress = PartOfProgress(options, 0.0, kScenesShare);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      plan.scenes,
      GeneratedScenes(making, {kFirstBuilding, options.quick ? 1 : kBuildings}, plan.duration_s));
  plan.trials = options.trials.value_or(1);
  plan.first_seed = options.seed;
  plan.peer = kPeer;
  plan.folder = absl::StrCat(options.folder, "/trials");
  plan.jobs = options.jobs;
  plan.progress = PartOfProgress(options, kScenesShare, 1.0);
  return plan;
}

// RMSE over that of an all-zero map, so that buildings with much gas do not count for more.
double ErrorShare(const TrialRecord& trial) {
  const MapMetrics& metrics = trial.curve.back().metrics;
  return metrics.rmse_ppm / metrics.rmse_zero_ppm;
}
double PeerShare(const TrialRecord& trial) {
  return trial.peer_rmse_ppm.value_or(0.0) / trial.curve.back().metrics.rmse_zero_ppm;
}
double Entropy_nats(const TrialRecord& trial) {
  return EntropyPerCell_nats(trial.curve.back().metrics);
}
double Complete(const TrialRecord& trial) {
  return kPercent * Completeness(trial.curve.back().metrics);
}

Spread SpreadBy(const std::vector<SceneRecords>& records, std::size_t row,
                double (*value)(const TrialRecord&)) {
  std::vector<double> means;  // of buildings: trials in one are not independent
  for (const SceneRecords& scene : records) {
    std::vector<double> values;
    for (const TrialRecord& trial : scene[row]) values.push_back(value(trial));
    means.push_back(SpreadOf(values).mean);
  }
  return SpreadOf(means);
}

TextTable MakeTextTable(const TrialPlan& plan, const std::vector<SceneRecords>& records) {
  TextTable table;
  table.title = "Means over buildings and trials [± 95 % interval]";
  table.columns = {"strategy",
                   "map",
                   "RMSE / that of an all-zero map",
                   "the same by Kernel DM+V",
                   "entropy, nats per critical cell",
                   "map complete"};
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    const auto text = [&](double (*value)(const TrialRecord&), const char* unit) {
      const Spread spread = SpreadBy(records, row, value);
      return absl::StrFormat("%.3g [± %.2g]%s", spread.mean, spread.half_95, unit);
    };
    table.rows.push_back({plan.rows[row].mission.planning.strategy,
                          plan.rows[row].knows_map ? "known" : "unknown", text(ErrorShare, ""),
                          text(PeerShare, ""), text(Entropy_nats, ""), text(Complete, " %")});
  }
  return table;
}

// Strategies side by side, with the map unknown and known.
BarChart MakeBars(const TrialPlan& plan, const std::vector<SceneRecords>& records,
                  const std::string& title, double (*value)(const TrialRecord&)) {
  BarChart chart{title, "strategy (numbers: rows of the table)", {}, {}, ""};
  BarSeries unknown{"map unknown", {36, 99, 201}, {}};
  BarSeries known{"map known", {214, 158, 46}, {}};
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    const Spread spread = SpreadBy(records, row, value);
    const Bar bar{spread.mean, std::max(0.0, spread.mean - spread.half_95),
                  spread.mean + spread.half_95};
    (plan.rows[row].knows_map ? known : unknown).bars.push_back(bar);
    if (!plan.rows[row].knows_map) chart.groups.push_back(absl::StrCat(row / 2 + 1));
  }
  chart.series = {std::move(unknown), std::move(known)};
  return chart;
}

void AddNumbers(const TrialPlan& plan, const std::vector<SceneRecords>& records, Study& study) {
  for (std::size_t row = 0; row < plan.rows.size(); ++row) {
    const std::string& name = plan.rows[row].name;
    study.summary.figures.emplace_back(name + "_rmse_share",
                                       SpreadBy(records, row, ErrorShare).mean);
    study.summary.figures.emplace_back(name + "_kernel_dmv_rmse_share",
                                       SpreadBy(records, row, PeerShare).mean);
    study.summary.figures.emplace_back(name + "_entropy_nats",
                                       SpreadBy(records, row, Entropy_nats).mean);
    study.summary.figures.emplace_back(name + "_completeness_percent",
                                       SpreadBy(records, row, Complete).mean);
    if (plan.rows[row].knows_map) continue;
    study.figures.key_numbers.emplace_back(
        absl::StrCat(row / 2 + 1, " ", plan.rows[row].mission.planning.strategy),
        absl::StrFormat("%.2f, known %.2f", SpreadBy(records, row, ErrorShare).mean,
                        SpreadBy(records, row + 1, ErrorShare).mean));
  }
}

std::vector<std::string> MakeNotes(const TrialPlan& plan) {
  return {
      absl::StrFormat("%d generated buildings, %d trial(s) of %.0f s with each strategy from the "
                      "same pose with the same sensors and seeds. Nothing was tuned in them.",
                      plan.scenes.size(), plan.trials, plan.duration_s),
      "With the map known, frontiers of the map do not exist: strategies that live on them alone "
      "drive to places with unobserved gas from the beginning. Strategies that stop at sites do so "
      "every metre for 2 s; readings are taken at 2 Hz on the way too.",
      "Kernel DM+V maps the same readings over the whole building with a kernel of 0.5 m; it knows "
      "no walls and has no variance to plan by, so it is a peer of the map alone.",
  };
}

}  // namespace

absl::StatusOr<Study> RunAllStrategies(const ExperimentOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const TrialPlan plan, MakePlan(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<SceneRecords> records, RunTrials(plan));
  Study study;
  study.figures.title = "All strategies in the same buildings";
  study.figures.notes = MakeNotes(plan);
  study.figures.tables = {MakeTextTable(plan, records)};
  study.figures.bar_charts = {
      MakeBars(plan, records, "RMSE / that of an all-zero map", ErrorShare),
      MakeBars(plan, records, "Entropy, nats per critical cell", Entropy_nats)};
  AddNumbers(plan, records, study);
  AddCalibration(FinalMaps(plan, records), study);
  study.table = MakeTrialTable(plan, records);
  study.summary.about = AboutThisRun(options.seed);
  for (const std::string& scene : plan.scenes) {
    study.summary.about.emplace_back("scene", SceneName(scene));
  }
  return study;
}

}  // namespace plumescout::lab
