// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_table3.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/formats/scene_folder.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "lab/studies/xit_calibration.h"
#include "lab/studies/xit_table3_rows.h"
#include "lab/trials/error_maps.h"
#include "lab/trials/row_figures.h"
#include "lab/trials/study_scenes.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {
namespace {

constexpr int kTrials = 20;
constexpr int kQuickTrials = 2;
constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 60.0;
constexpr double kPercent = 100.0;

using Records = std::vector<SceneRecords>;

absl::StatusOr<TrialPlan> MakePlan(const ExperimentOptions& options) {
  TrialPlan plan;
  for (const Table3Row& row : Table3Rows()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made, MakeTable3Row(row));
    plan.rows.push_back(std::move(made));
  }
  plan.duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  plan.trials = options.trials.value_or(options.quick ? kQuickTrials : kTrials);
  plan.first_seed = options.seed;
  constexpr double kShares[] = {0.2, 0.5, 1.0};  // 60, 150 and 300 s
  for (const double share : kShares) plan.map_times_s.push_back(share * plan.duration_s);
  plan.folder = absl::StrCat(options.folder, "/trials");
  plan.tells_other_entropies = true;
  plan.jobs = options.jobs;
  plan.progress = options.progress;
  PLUMESCOUT_ASSIGN_OR_RETURN(plan.scenes, HallScene(options, plan.duration_s));
  return plan;
}

const Table3Row& RowAt(std::size_t row) { return Table3Rows()[row]; }
std::size_t RowCount() { return Table3Rows().size(); }

// A figure of a trial at its end.
using ValueFn = double (*)(const TrialRecord&);
double FinalRmse(const TrialRecord& trial) { return Rmse_ppm(trial.curve.back().metrics); }
double FinalEntropy(const TrialRecord& trial) { return Entropy_nats(trial.curve.back().metrics); }
double FinalPerCell(const TrialRecord& trial) {
  return EntropyPerCell_nats(trial.curve.back().metrics);
}
double PropagatedPerCell(const TrialRecord& trial) {
  return trial.other_entropies->propagated_nats / trial.curve.back().metrics.critical_cells;
}
double BuildingPerCell(const TrialRecord& trial) {
  return trial.other_entropies->whole_building_nats / trial.curve.back().metrics.critical_cells;
}

struct RowResult {
  Spread spread;
  Reduction reduction;
  double p = 1.0;
};

RowResult Compare(const std::vector<double>& values, const std::vector<double>& baseline) {
  return {SpreadOf(values), ReductionOf(values, baseline), PairedPValue(values, baseline)};
}

RowResult Compare(const Records& records, std::size_t row, std::size_t baseline, ValueFn value) {
  return Compare(UnitsOf(records, row, value), UnitsOf(records, baseline, value));
}

std::string Text(const Spread& spread, int digits) {
  return absl::StrFormat("%.*f ± %.*f", digits, spread.mean, digits, spread.stddev);
}

std::string Text(const RowResult& result) {
  return absl::StrFormat("%.1f %% [%.1f, %.1f], p = %.2g", result.reduction.percent,
                         result.reduction.low_95, result.reduction.high_95, result.p);
}

std::string PaperText(const Printed& printed, double baseline, int digits) {
  if (std::isnan(printed.mean)) return "–";
  return absl::StrFormat("%.*f ± %.*f (%.1f %%)", digits, printed.mean, digits, printed.stddev,
                         kPercent * (baseline - printed.mean) / baseline);
}

TextTable MakeTextTable(const Records& records) {
  TextTable table;
  table.title =
      "At the end: mean ± standard deviation; less than row 1 [95 % interval], paired p. Rows 1 to "
      "6 "
      "are published ones to the letter, 7 and 8 their other reading, 9 to 11 ours";
  table.columns = {"row",     "method", "cost", "RMSE, ppm", "less",
                   "paper's", "nats",   "less", "paper's",   "map"};
  for (std::size_t row = 0; row < RowCount(); ++row) {
    const RowResult rmse = Compare(records, row, kPaperBaseline, FinalRmse);
    const RowResult entropy = Compare(records, row, kPaperBaseline, FinalEntropy);
    const Spread complete = SpreadOf(Finals(records, row, Completeness));
    const Table3Row& about = RowAt(row);
    const bool base = row == kPaperBaseline;
    table.rows.push_back({absl::StrCat(row + 1), about.method, about.cost, Text(rmse.spread, 1),
                          base ? "–" : Text(rmse),
                          PaperText(about.rmse_ppm, RowAt(kPaperBaseline).rmse_ppm.mean, 1),
                          Text(entropy.spread, 0), base ? "–" : Text(entropy),
                          PaperText(about.entropy_nats, RowAt(kPaperBaseline).entropy_nats.mean, 0),
                          absl::StrFormat("%.1f %%", kPercent * complete.mean)});
  }
  return table;
}

// One entropy, three ways to reckon it.
TextTable MakeEntropyTable(const Records& records) {
  struct Way {
    const char* name;
    ValueFn value;
  };
  constexpr Way kWays[] = {{"exact, nats per cell", FinalPerCell},
                           {"belief propagation", PropagatedPerCell},
                           {"whole building, exact", BuildingPerCell}};
  TextTable table;
  table.title =
      "Entropy per critical cell, and less than row 1 [95 % interval]: by the mission's exact "
      "variances; by those of belief propagation on the same map, as in the paper; and by exact "
      "ones "
      "over the whole building, a set of cells that is the same for all";
  table.columns = {"row", "method", "cost"};
  for (const Way& way : kWays) table.columns.insert(table.columns.end(), {way.name, "less"});
  for (std::size_t row = 0; row < RowCount(); ++row) {
    std::vector<std::string> texts = {absl::StrCat(row + 1), RowAt(row).method, RowAt(row).cost};
    for (const Way& way : kWays) {
      const RowResult result = Compare(records, row, kPaperBaseline, way.value);
      texts.push_back(Text(result.spread, 3));
      texts.push_back(row == kPaperBaseline ? "–" : Text(result));
    }
    table.rows.push_back(std::move(texts));
  }
  return table;
}

// Against the baseline that goes on reading.
TextTable MakeStrongTable(const Records& records) {
  TextTable table;
  table.title =
      absl::StrFormat("Less than row %d, which goes on to random places", kStrongBaseline + 1);
  table.columns = {"row", "method", "cost", "RMSE", "entropy"};
  for (std::size_t row = 0; row < RowCount(); ++row) {
    if (row == kStrongBaseline) continue;
    table.rows.push_back({absl::StrCat(row + 1), RowAt(row).method, RowAt(row).cost,
                          Text(Compare(records, row, kStrongBaseline, FinalRmse)),
                          Text(Compare(records, row, kStrongBaseline, FinalEntropy))});
  }
  return table;
}

// Fig. 8: the paper's rows.
std::vector<RowStyle> MakeStyles() {
  constexpr Rgb kColors[] = {{36, 99, 201},  {120, 160, 60},  {214, 158, 46},
                             {20, 140, 140}, {150, 110, 190}, {206, 30, 60}};
  std::vector<RowStyle> styles;
  for (std::size_t row = 0; row < std::size(kColors); ++row) {
    styles.push_back(
        {LabelOf(RowAt(row)), kColors[row], row == kPaperBaseline || row == kPaperBest});
  }
  return styles;
}

// Table III as bars, the paper's values as marks.
BarChart MakeBarChart(const Records& records, const std::string& title, ValueFn value,
                      Printed Table3Row::*printed) {
  BarChart chart{title, "row of the table", {}, {{"", {110, 130, 160}, {}}}, ""};
  for (std::size_t row = 0; row < RowCount(); ++row) {
    const Spread spread = SpreadOf(UnitsOf(records, row, value));
    chart.groups.push_back(absl::StrCat(row + 1));
    chart.series.front().bars.push_back({spread.mean, spread.mean - spread.half_95,
                                         spread.mean + spread.half_95, (RowAt(row).*printed).mean});
  }
  return chart;
}

// A row may fall behind because it misses one room full of gas, or everywhere.
TextTable MakePartTable(const Scene& scene, const SceneRecords& records, std::size_t map) {
  TextTable table;
  table.title = absl::StrFormat(
      "Where the error lies in %s: the twentieth of the critical cells with the most gas (%.0f %% "
      "of the squared concentrations) and the others",
      scene.name, kPercent * ShareOfSquares(scene, GasPart::kMost));
  table.columns = {"row", "method", "cost", "RMSE, most gas, ppm", "less", "RMSE, others, ppm",
                   "less"};
  for (std::size_t row = 0; row < RowCount(); ++row) {
    std::vector<std::string> texts = {absl::StrCat(row + 1), RowAt(row).method, RowAt(row).cost};
    for (const GasPart part : {GasPart::kMost, GasPart::kRest}) {
      const RowResult result = Compare(PartErrors_ppm(scene, records[row], map, part),
                                       PartErrors_ppm(scene, records[kPaperBaseline], map, part));
      texts.push_back(Text(result.spread, 1));
      texts.push_back(row == kPaperBaseline ? "–" : Text(result));
    }
    table.rows.push_back(std::move(texts));
  }
  return table;
}

// Fig. 9, of the first building.
absl::Status AddErrorMaps(const TrialPlan& plan, const Records& records, ReportFigures& figures) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Scene scene, ReadScene(plan.scenes.front()));
  figures.tables.push_back(MakePartTable(scene, records.front(), plan.map_times_s.size() - 1));
  for (const std::size_t row : {kPaperBaseline, kPaperBest}) {
    for (std::size_t map = 0; map < plan.map_times_s.size(); ++map) {
      const std::string title =
          absl::StrFormat("%s, %.0f s", LabelOf(RowAt(row)), plan.map_times_s[map]);
      figures.panels.push_back(MakeErrorPanel(scene, records.front()[row], map, title));
    }
  }
  return absl::OkStatus();
}

// The row's share of the oracle's gain over the baseline, of the means over trials and buildings.
double OracleShare(const Records& records, std::size_t row, const std::vector<MapMetrics>& oracles,
                   MetricFn metric) {
  std::vector<double> best;
  for (const MapMetrics& oracle : oracles) best.push_back(metric(oracle));
  const double base = SpreadOf(Finals(records, kPaperBaseline, metric)).mean;
  return (base - SpreadOf(Finals(records, row, metric)).mean) / (base - SpreadOf(best).mean);
}

void AddKeyNumber(std::size_t row, const char* what, const RowResult& result, Study& study) {
  if (row != kPaperBest && row != kOwnStrategy) return;
  study.figures.key_numbers.emplace_back(
      absl::StrCat(LabelOf(RowAt(row)), ": less ", what),
      absl::StrFormat("%.1f %%, p = %.2g", result.reduction.percent, result.p));
}

void AddNumbers(const Records& records, const std::vector<MapMetrics>& oracles, Study& study) {
  struct Figure {
    const char* name;
    const char* with_unit;
    ValueFn value;
    MetricFn by_cell;  // of the oracle, which may have judged fewer cells; null: not compared
  };
  constexpr Figure kFigures[] = {
      {"rmse", "rmse_ppm", FinalRmse, Rmse_ppm},
      {"entropy", "entropy", FinalEntropy, EntropyPerCell_nats},
      {"entropy_per_cell", "entropy_per_cell", FinalPerCell, nullptr},
      {"entropy_bp_per_cell", "entropy_bp_per_cell", PropagatedPerCell, nullptr},
      {"entropy_building_per_cell", "entropy_building_per_cell", BuildingPerCell, nullptr}};
  auto& figures = study.summary.figures;
  for (const auto& [name, with_unit, value, by_cell] : kFigures) {
    for (std::size_t row = 0; row < RowCount(); ++row) {
      const RowResult result = Compare(records, row, kPaperBaseline, value);
      const std::string of_row = absl::StrCat(RowAt(row).name, "_");
      figures.emplace_back(absl::StrCat(of_row, with_unit, "_mean"), result.spread.mean);
      figures.emplace_back(absl::StrCat(of_row, with_unit, "_std"), result.spread.stddev);
      figures.emplace_back(absl::StrCat(of_row, with_unit, "_half_95"), result.spread.half_95);
      const std::string reduction = absl::StrCat(of_row, name, "_reduction_percent");
      figures.emplace_back(reduction, result.reduction.percent);
      figures.emplace_back(reduction + "_low_95", result.reduction.low_95);
      figures.emplace_back(reduction + "_high_95", result.reduction.high_95);
      figures.emplace_back(absl::StrCat(of_row, name, "_p_value"), result.p);
      if (by_cell == nullptr) continue;
      figures.emplace_back(absl::StrCat(of_row, name, "_oracle_share"),
                           OracleShare(records, row, oracles, by_cell));
      AddKeyNumber(row, name, result, study);
    }
  }
}

void AddCompleteness(const Records& records, int trials, Summary& summary) {
  for (std::size_t row = 0; row < RowCount(); ++row) {
    summary.figures.emplace_back(absl::StrCat(RowAt(row).name, "_completeness_mean"),
                                 SpreadOf(Finals(records, row, Completeness)).mean);
  }
  summary.figures.emplace_back("trials", trials);
}

std::vector<std::string> MakeNotes(const TrialPlan& plan) {
  const TrialRobot robot = CalibratedRobot();
  return {
      absl::StrFormat(
          "The paper drives a simulated robot for 300 s through a hall of 16 m x 20 m with three "
          "leaks, twenty times with each planner. Its building and gas are not public; ours has "
          "its size, wind speed, release rates and threshold, and another plan. Here: %d trials "
          "of %.0f s in %s. The robot's LiDAR of %.1f m was chosen by the baseline alone "
          "(xit_calibration); each plan takes the paper's %.2f s.",
          plan.trials, plan.duration_s, SceneName(plan.scenes.front()), robot.lidar_range_m,
          robot.plan_latency_s),
      "Rows 1 to 8 are the paper to the letter: 300 independent samples, Eq. (8) with the variance "
      "as it is, the radius of Eq. (7) times 1.1 without a limit, paths that end at samples, "
      "Algorithm 2 where the robot is, gas as the sensor tells it; a search that finds nothing is "
      "made again. Row 1 stops when no frontier is left, the others then go to random places "
      "(section VII). Ours: systematic samples, paths that end at frontiers, all frontiers that "
      "can "
      "be reached, missed goals completed on the grid, straight paths, the sensor's lag undone. "
      "All start at the same pose, and trial k of every row has seed k: p is of a paired "
      "permutation test, intervals of reductions are by bootstrap over pairs.",
      "A percentage of a differential entropy depends on the unit of the variance: compare nats "
      "per "
      "cell. A critical cell that nobody has seen counts with the prior of an open lattice, which "
      "is "
      "less than that of one that was seen and not measured, so that seeing more raises the "
      "entropy; "
      "over the whole building all rows have the same cells.",
  };
}

}  // namespace

absl::StatusOr<Study> RunXitTable3(const ExperimentOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const TrialPlan plan, MakePlan(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Records records, RunTrials(plan));
  Study study;
  study.figures.title = "Planners for gas mapping, side by side ([XIT] Table III, Fig. 8 and 9)";
  study.figures.notes = MakeNotes(plan);
  study.figures.tables = {MakeTextTable(records), MakeEntropyTable(records),
                          MakeStrongTable(records)};
  const std::vector<RowStyle> styles = MakeStyles();
  study.figures.charts = {
      MakeMetricChart(records, styles, "RMSE, critical cells, ppm", Rmse_ppm),
      MakeMetricChart(records, styles, "Entropy, critical cells, nats", Entropy_nats),
      MakeMetricChart(records, styles, "Completeness", Completeness)};
  study.figures.bar_charts = {MakeBarChart(records, "RMSE at the end, ppm (mark: the paper's)",
                                           FinalRmse, &Table3Row::rmse_ppm),
                              MakeBarChart(records, "Entropy at the end, nats (mark: the paper's)",
                                           FinalEntropy, &Table3Row::entropy_nats)};
  PLUMESCOUT_RETURN_IF_ERROR(AddErrorMaps(plan, records, study.figures));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<MapMetrics> oracles,
                              OracleMetrics(plan, records, kStrongBaseline, nullptr));
  AddNumbers(records, oracles, study);
  AddCompleteness(records, plan.trials, study.summary);
  AddCalibration(FinalMaps(plan, records), study);
  study.table = MakeTrialTable(plan, records);
  study.summary.about = AboutThisRun(options.seed);
  study.summary.about.emplace_back("trials", absl::StrCat(plan.trials));
  for (const std::string& scene : plan.scenes) {
    study.summary.about.emplace_back("scene", SceneName(scene));
  }
  return study;
}

}  // namespace plumescout::lab
