// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_calibration.h"

#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/report/palette.h"
#include "lab/trials/row_figures.h"
#include "lab/trials/study_scenes.h"

namespace plumescout::lab {
namespace {

constexpr double kRanges_m[] = {3.0, 3.5, 4.0, 5.0, 6.0, 8.0};
constexpr std::uint64_t kSeedsApart = 1000;  // from those of Table III
constexpr int kTrials = 5;
constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 60.0;
constexpr double kCovered = 0.98;
constexpr double kPercent = 100.0;

absl::StatusOr<TrialPlan> MakePlan(const ExperimentOptions& options) {
  TrialPlan plan;
  for (const double range_m : kRanges_m) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        StudyRow row,
        MakePublishedRow(absl::StrFormat("range_%02.0f_dm", 10.0 * range_m), "rrt_star_frontier"));
    row.robot = CalibratedRobot();
    row.robot.lidar_range_m = range_m;
    row.robot.stops_without_frontier = true;
    plan.rows.push_back(std::move(row));
  }
  plan.trials = options.trials.value_or(options.quick ? 1 : kTrials);
  plan.first_seed = kSeedsApart + options.seed;
  plan.duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  plan.folder = absl::StrCat(options.folder, "/trials");
  plan.jobs = options.jobs;
  plan.progress = options.progress;
  PLUMESCOUT_ASSIGN_OR_RETURN(plan.scenes, HallScene(options, plan.duration_s));
  return plan;
}

// Completeness when half of the time is over; a trial that has ended keeps what it has.
std::vector<double> Halfway(const std::vector<SceneRecords>& records, std::size_t row,
                            double half_s) {
  std::vector<double> shares;
  for (const SceneRecords& scene : records) {
    for (const TrialRecord& trial : scene[row]) {
      double share = 0.0;
      for (const CurvePoint& point : trial.curve) {
        if (point.time_s <= half_s) share = point.metrics.completeness;
      }
      shares.push_back(share);
    }
  }
  return shares;
}

std::vector<double> Ends_s(const std::vector<SceneRecords>& records, std::size_t row) {
  std::vector<double> ends_s;
  for (const SceneRecords& scene : records) {
    for (const TrialRecord& trial : scene[row]) ends_s.push_back(trial.curve.back().time_s);
  }
  return ends_s;
}

std::string Text(const Spread& spread, double scale, int digits) {
  return absl::StrFormat("%.*f ± %.*f", digits, scale * spread.mean, digits, scale * spread.stddev);
}

void AddRows(const TrialPlan& plan, const std::vector<SceneRecords>& records, TextTable& table,
             Summary& summary) {
  for (std::size_t row = 0; row < std::size(kRanges_m); ++row) {
    const Spread halfway = SpreadOf(Halfway(records, row, plan.duration_s / 2.0));
    const Spread ends_s = SpreadOf(Ends_s(records, row));
    const Spread rmse_ppm = SpreadOf(Finals(records, row, Rmse_ppm));
    const Spread entropy = SpreadOf(Finals(records, row, Entropy_nats));
    const Spread by_cell = SpreadOf(Finals(records, row, EntropyPerCell_nats));
    table.rows.push_back({absl::StrFormat("%.1f m", kRanges_m[row]), Text(halfway, kPercent, 1),
                          halfway.mean >= kCovered ? "yes" : "no", Text(ends_s, 1.0, 0),
                          Text(rmse_ppm, 1.0, 1), Text(entropy, 1.0, 0), Text(by_cell, 1.0, 3)});
    const std::string prefix = plan.rows[row].name + "_";
    summary.figures.emplace_back(prefix + "halfway_completeness_mean", halfway.mean);
    summary.figures.emplace_back(prefix + "end_s_mean", ends_s.mean);
    summary.figures.emplace_back(prefix + "rmse_ppm_mean", rmse_ppm.mean);
    summary.figures.emplace_back(prefix + "rmse_ppm_std", rmse_ppm.stddev);
    summary.figures.emplace_back(prefix + "entropy_mean", entropy.mean);
    summary.figures.emplace_back(prefix + "entropy_per_cell_mean", by_cell.mean);
  }
}

}  // namespace

TrialRobot CalibratedRobot() {
  constexpr double kPlanLatency_s = 0.74;
  constexpr double kRange_m = 4.0;
  TrialRobot robot;
  robot.lidar_range_m = kRange_m;
  robot.plan_latency_s = kPlanLatency_s;
  robot.corrects_gas_lag = false;
  return robot;
}

absl::StatusOr<Study> RunXitCalibration(const ExperimentOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const TrialPlan plan, MakePlan(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<SceneRecords> records, RunTrials(plan));
  Study study;
  study.figures.title = "The baseline of [XIT] Table III by the range of the LiDAR";
  study.figures.notes = {absl::StrFormat(
      "The paper prints neither the range of its LiDAR nor its hall. Of its baseline it prints "
      "20.0 "
      "± 4.4 ppm and 1254 ± 244 nats at the end, and near-complete maps by the halfway mark; of "
      "planning, 0.74 s a plan. Here: that row to the letter, stopping when no frontier is left, "
      "%d trials of %.0f s by range. The rule: the shortest range with %.0f %% of the map "
      "halfway; the hall stays if the error is within the paper's.",
      plan.trials, plan.duration_s, kPercent * kCovered)};
  TextTable table;
  table.title = "At the end: mean ± standard deviation";
  table.columns = {"range",     "map halfway, %", "covered",      "stops, s",
                   "RMSE, ppm", "entropy, nats",  "nats per cell"};
  AddRows(plan, records, table, study.summary);
  study.figures.tables = {std::move(table)};
  std::vector<RowStyle> styles;
  for (std::size_t row = 0; row < std::size(kRanges_m); ++row) {
    styles.push_back({absl::StrFormat("%.1f m", kRanges_m[row]), kLineColors[row]});
  }
  study.figures.charts = {MakeMetricChart(records, styles, "Completeness", Completeness),
                          MakeMetricChart(records, styles, "RMSE, critical cells, ppm", Rmse_ppm)};
  AddCalibration(FinalMaps(plan, records), study);
  study.table = MakeTrialTable(plan, records);
  study.summary.figures.emplace_back("trials", plan.trials);
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
