// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_table3.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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
#include "lab/trials/error_maps.h"
#include "lab/trials/row_figures.h"
#include "lab/trials/study_scenes.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kTrials = 20;
constexpr int kQuickTrials = 2;
constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 60.0;
constexpr double kPercent = 100.0;

// Mean and standard deviation as printed; NaN where the paper has no such row.
struct Printed {
  double mean = kNan;
  double stddev = kNan;
};

struct TableRow {
  const char* name;
  const char* method;
  const char* cost;
  const char* strategy;
  CostKind expansion;
  CostKind selection;
  Printed rmse_ppm;      // Table III
  Printed entropy_nats;  // Table III
};

constexpr std::size_t kBaseline = 0;
constexpr std::size_t kBest = 5;  // the paper's
constexpr std::size_t kOwn = 8;
constexpr CostKind kUcb = CostKind::kUcb;
constexpr CostKind kLength = CostKind::kEuclidean;
constexpr TableRow kRows[] = {
    {"rrt_star_frontier",
     "RRT* frontier exploration",
     "Euclidean",
     "rrt_star_frontier",
     kLength,
     kLength,
     {20.0, 4.4},
     {1254, 244}},
    {"xit_f_ucb", "XIT-F", "UCB", "xit_f", kUcb, kUcb, {17.2, 3.1}, {1088, 280}},
    {"xit_fgf_euclidean",
     "XIT-FGF",
     "Euclidean",
     "xit_fgf",
     kLength,
     kLength,
     {19.1, 3.5},
     {1169, 245}},
    {"xit_fgf_ucb", "XIT-FGF", "UCB", "xit_fgf", kUcb, kUcb, {17.9, 4.7}, {1022, 217}},
    {"xit_gff_euclidean",
     "XIT-GFF",
     "Euclidean",
     "xit_gff",
     kLength,
     kLength,
     {18.3, 4.4},
     {1096, 263}},
    {"xit_gff_ucb", "XIT-GFF", "UCB", "xit_gff", kUcb, kUcb, {14.9, 1.9}, {957, 169}},
    {"xit_fgf_euclidean_tree",
     "XIT-FGF",
     "Euclidean tree, UCB choice",
     "xit_fgf",
     kLength,
     kUcb,
     {},
     {}},
    {"xit_gff_euclidean_tree",
     "XIT-GFF",
     "Euclidean tree, UCB choice",
     "xit_gff",
     kLength,
     kUcb,
     {},
     {}},
    {"plumescout", "plumescout (ours)", "UCB", "plumescout", kUcb, kUcb, {}, {}},
};

absl::StatusOr<StudyRow> MakeRow(const TableRow& row) {
  const bool own = &row == &kRows[kOwn];
  PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made, MakeStudyRow(row.name, row.strategy, !own));
  PlanningOptions& planning = made.mission.planning;
  planning.cost = row.expansion;
  planning.selection_cost = row.selection;
  planning.straighten = row.expansion == kUcb;
  return made;
}

absl::StatusOr<TrialPlan> MakePlan(const ExperimentOptions& options) {
  TrialPlan plan;
  for (const TableRow& row : kRows) {
    PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made, MakeRow(row));
    plan.rows.push_back(std::move(made));
  }
  plan.duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  plan.trials = options.trials.value_or(options.quick ? kQuickTrials : kTrials);
  plan.first_seed = options.seed;
  constexpr double kShares[] = {0.2, 0.5, 1.0};  // 60, 150 and 300 s
  for (const double share : kShares) plan.map_times_s.push_back(share * plan.duration_s);
  plan.folder = absl::StrCat(options.folder, "/trials");
  plan.jobs = options.jobs;
  plan.progress = options.progress;
  PLUMESCOUT_ASSIGN_OR_RETURN(plan.scenes, HallScene(options, plan.duration_s));
  return plan;
}

struct RowResult {
  Spread spread;
  double reduction_percent = 0.0;
  double p = 1.0;  // against the baseline
};

RowResult Compare(const std::vector<double>& values, const std::vector<double>& baseline) {
  RowResult result;
  result.spread = SpreadOf(values);
  const double base = SpreadOf(baseline).mean;
  result.reduction_percent = kPercent * (base - result.spread.mean) / std::abs(base);
  result.p = PairedPValue(values, baseline);
  return result;
}

RowResult Compare(const std::vector<SceneRecords>& records, std::size_t row, MetricFn metric) {
  return Compare(Finals(records, row, metric), Finals(records, kBaseline, metric));
}

std::string Text(const RowResult& result, const char* format) {
  const auto number = [&](double value) {
    return absl::StrFormat(*absl::ParsedFormat<'f'>::New(format), value);
  };
  return absl::StrCat(number(result.spread.mean), " ± ", number(result.spread.stddev), " [± ",
                      number(result.spread.half_95), "]");
}

std::string PaperText(const Printed& printed, double baseline, const char* format) {
  if (std::isnan(printed.mean)) return "–";
  const auto parsed = absl::ParsedFormat<'f', 'f', 'f'>::New(format);
  return absl::StrFormat(*parsed, printed.mean, printed.stddev,
                         kPercent * (baseline - printed.mean) / baseline);
}

std::string ReductionText(const RowResult& result) {
  return absl::StrFormat("%.1f %%, p = %.3g", result.reduction_percent, result.p);
}

TextTable MakeTextTable(const std::vector<SceneRecords>& records) {
  TextTable table;
  table.title = "At the end: mean ± standard deviation [± 95 % interval of the mean]";
  table.columns = {"method",
                   "cost",
                   "RMSE, ppm",
                   "less, p",
                   "paper's RMSE (less)",
                   "entropy, nats",
                   "less, p",
                   "paper's entropy (less)",
                   "map complete"};
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    const RowResult rmse = Compare(records, row, Rmse_ppm);
    const RowResult entropy = Compare(records, row, Entropy_nats);
    const Spread complete = SpreadOf(Finals(records, row, Completeness));
    table.rows.push_back(
        {kRows[row].method, kRows[row].cost, Text(rmse, "%.2f"), ReductionText(rmse),
         PaperText(kRows[row].rmse_ppm, kRows[kBaseline].rmse_ppm.mean, "%.1f ± %.1f (%.1f %%)"),
         Text(entropy, "%.0f"), ReductionText(entropy),
         PaperText(kRows[row].entropy_nats, kRows[kBaseline].entropy_nats.mean,
                   "%.0f ± %.0f (%.1f %%)"),
         absl::StrFormat("%.1f %%", kPercent * complete.mean)});
  }
  return table;
}

std::vector<RowStyle> MakeStyles() {
  constexpr Rgb kColors[] = {{36, 99, 201},   {120, 160, 60},  {214, 158, 46},
                             {196, 110, 40},  {150, 110, 190}, {206, 30, 60},
                             {190, 190, 190}, {140, 140, 140}, {20, 130, 90}};
  std::vector<RowStyle> styles;
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    styles.push_back({absl::StrCat(kRows[row].method, " ", kRows[row].cost), kColors[row],
                      row == kBaseline || row == kBest});
  }
  return styles;
}

// A row may fall behind because it misses one room full of gas, or everywhere.
TextTable MakePartTable(const Scene& scene, const SceneRecords& records, std::size_t map) {
  TextTable table;
  table.title = absl::StrFormat(
      "Where the error lies in %s: the twentieth of the critical cells with the most gas (%.0f %% "
      "of the squared concentrations) and the others",
      scene.name, kPercent * ShareOfSquares(scene, GasPart::kMost));
  table.columns = {"method", "cost", "RMSE, most gas, ppm", "less, p", "RMSE, others, ppm",
                   "less, p"};
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    std::vector<std::string> texts = {kRows[row].method, kRows[row].cost};
    for (const GasPart part : {GasPart::kMost, GasPart::kRest}) {
      const RowResult result = Compare(PartErrors_ppm(scene, records[row], map, part),
                                       PartErrors_ppm(scene, records[kBaseline], map, part));
      texts.push_back(Text(result, "%.2f"));
      texts.push_back(ReductionText(result));
    }
    table.rows.push_back(std::move(texts));
  }
  return table;
}

// Of the first building.
absl::Status AddErrorMaps(const TrialPlan& plan, const std::vector<SceneRecords>& records,
                          ReportFigures& figures) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Scene scene, ReadScene(plan.scenes.front()));
  figures.tables.push_back(MakePartTable(scene, records.front(), plan.map_times_s.size() - 1));
  for (const std::size_t row : {kBaseline, kBest}) {
    for (std::size_t map = 0; map < plan.map_times_s.size(); ++map) {
      const std::string title = absl::StrFormat("%s %s, %.0f s", kRows[row].method, kRows[row].cost,
                                                plan.map_times_s[map]);
      figures.panels.push_back(MakeErrorPanel(scene, records.front()[row], map, title));
    }
  }
  return absl::OkStatus();
}

// The row's share of the oracle's gain over the baseline, of the means over trials and buildings.
double OracleShare(const std::vector<SceneRecords>& records, std::size_t row,
                   const std::vector<MapMetrics>& oracles, MetricFn metric) {
  std::vector<double> best;
  for (const MapMetrics& oracle : oracles) best.push_back(metric(oracle));
  const double base = SpreadOf(Finals(records, kBaseline, metric)).mean;
  return (base - SpreadOf(Finals(records, row, metric)).mean) / (base - SpreadOf(best).mean);
}

void AddNumbers(const std::vector<SceneRecords>& records, const std::vector<MapMetrics>& oracles,
                Study& study) {
  struct Metric {
    const char* name;
    const char* with_unit;
    MetricFn of;
    MetricFn by_cell;  // the oracle may have judged fewer cells
  };
  constexpr Metric kMetrics[] = {{"rmse", "rmse_ppm", Rmse_ppm, Rmse_ppm},
                                 {"entropy", "entropy", Entropy_nats, EntropyPerCell_nats}};
  auto& figures = study.summary.figures;
  for (const auto& [name, with_unit, metric, by_cell] : kMetrics) {
    for (std::size_t row = 0; row < std::size(kRows); ++row) {
      const RowResult result = Compare(records, row, metric);
      const std::string of_row = absl::StrCat(kRows[row].name, "_");
      figures.emplace_back(absl::StrCat(of_row, with_unit, "_mean"), result.spread.mean);
      figures.emplace_back(absl::StrCat(of_row, with_unit, "_std"), result.spread.stddev);
      figures.emplace_back(absl::StrCat(of_row, with_unit, "_half_95"), result.spread.half_95);
      figures.emplace_back(absl::StrCat(of_row, name, "_reduction_percent"),
                           result.reduction_percent);
      figures.emplace_back(absl::StrCat(of_row, name, "_p_value"), result.p);
      figures.emplace_back(absl::StrCat(of_row, name, "_oracle_share"),
                           OracleShare(records, row, oracles, by_cell));
      if (row == kBest || row == kOwn) {
        study.figures.key_numbers.emplace_back(
            absl::StrCat(kRows[row].method, " ", kRows[row].cost, ": less ",
                         metric == Rmse_ppm ? "RMSE" : "entropy"),
            ReductionText(result));
      }
    }
  }
}

void AddCompleteness(const std::vector<SceneRecords>& records, int trials, Summary& summary) {
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    summary.figures.emplace_back(absl::StrCat(kRows[row].name, "_completeness_mean"),
                                 SpreadOf(Finals(records, row, Completeness)).mean);
  }
  summary.figures.emplace_back("trials", trials);
}

std::vector<std::string> MakeNotes(const TrialPlan& plan) {
  return {
      absl::StrFormat(
          "The paper drives a simulated robot for 300 s through a hall of 16 m x 20 m with three "
          "leaks, twenty times with each planner. Its building and gas are not public; ours has "
          "its size, wind speed, release rates and threshold, and another plan. Here: %d trials "
          "of %.0f s in %s.",
          plan.trials, plan.duration_s, SceneName(plan.scenes.front())),
      "Fairness: every row starts at the same pose, with the same LiDAR and gas sensor, and trial "
      "k "
      "of every row has seed k, so that rows are compared pair by pair (permutation test). All "
      "rows draw up to five goals at random within a kind, all get the same grid guard (goals "
      "that a tree misses are completed on the grid), and once no frontier is left all but our "
      "own go to random free places until the time is up. RRT* has as many samples as XIT, each "
      "goal a tree of its own.",
      "The paper says that the Euclidean rows expand their tree by length and is silent on how "
      "they choose: both readings are here. Our own strategy is not of the paper; it chooses by "
      "expected information and takes nothing at random.",
  };
}

}  // namespace

absl::StatusOr<Study> RunXitTable3(const ExperimentOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const TrialPlan plan, MakePlan(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<SceneRecords> records, RunTrials(plan));
  Study study;
  study.figures.title = "Planners for gas mapping, side by side ([XIT] Table III)";
  study.figures.notes = MakeNotes(plan);
  study.figures.tables = {MakeTextTable(records)};
  const std::vector<RowStyle> styles = MakeStyles();
  study.figures.charts = {
      MakeMetricChart(records, styles, "RMSE, critical cells, ppm", Rmse_ppm),
      MakeMetricChart(records, styles, "Entropy, critical cells, nats", Entropy_nats),
      MakeMetricChart(records, styles, "Completeness", Completeness)};
  PLUMESCOUT_RETURN_IF_ERROR(AddErrorMaps(plan, records, study.figures));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<MapMetrics> oracles,
                              OracleMetrics(plan, records, kBaseline, nullptr));
  AddNumbers(records, oracles, study);
  AddCompleteness(records, plan.trials, study.summary);
  study.table = MakeTrialTable(plan, records);
  study.summary.about = AboutThisRun(options.seed);
  study.summary.about.emplace_back("trials", absl::StrCat(plan.trials));
  for (const std::string& scene : plan.scenes) {
    study.summary.about.emplace_back("scene", SceneName(scene));
  }
  return study;
}

}  // namespace plumescout::lab
