// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/lhr_table2.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/studies/lhr_rows.h"
#include "lab/trials/convergence.h"
#include "lab/trials/sampling_pictures.h"
#include "lab/trials/sampling_study.h"
#include "lab/trials/statistics.h"
#include "lab/trials/tour_cost.h"
#include "lab/worlds/lhr_scene.h"

namespace plumescout::lab {
namespace {

constexpr int kWorlds = 5;
constexpr double kSecondsPerMinute = 60.0;
constexpr double kWholeMission_s = 50'000.0;

constexpr std::size_t kSweep = 0;
constexpr std::size_t kPictured = 3;  // Fig. 3 is of UCB

absl::StatusOr<SamplingPlan> MakeTablePlan(const ExperimentOptions& options) {
  const int count = options.trials.value_or(options.quick ? 1 : kWorlds);
  std::vector<Scene> worlds;
  for (int i = 0; i < count; ++i) {
    worlds.push_back(MakeLhrScene(LhrScenarioSources(options.seed, i)));
  }
  SamplingPlan plan =
      MakeLhrDrives(options, std::move(worlds), options.quick ? 1 : LhrStarts().size());
  for (const LhrRow& row : kLhrRows) {
    PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made,
                                MakeLhrStudyRow(row, kLhrUnstated, plan.worlds.front().geometry()));
    plan.rows.push_back(std::move(made));
  }
  return plan;
}

using Drives = std::vector<std::vector<SamplingDrive>>;
using Figure = std::function<double(const SamplingDrive&)>;

double Elapsed_min(const SamplingDrive& drive) { return drive.elapsed_s / kSecondsPerMinute; }
double Final_ppm(const SamplingDrive& drive) { return drive.errors.back().rmse_ppm; }
double Convergence_min(const SamplingDrive& drive) { return LhrConvergence_min(drive); }
Figure ConvergenceIn(double band) {
  return [band](const SamplingDrive& drive) { return LhrConvergence_min(drive, band); };
}

// Means over worlds, which are independent of each other as drives in one world are not.
Spread SpreadBy(const SamplingPlan& plan, const std::vector<SamplingDrive>& drives,
                const Figure& figure) {
  return SpreadOf(MeansByWorld(plan, drives, figure));
}

// Root mean square of the gas, which is the error of a map of nothing: the mean over worlds.
double TruthRms_ppm(const std::vector<Scene>& worlds) {
  double sum_ppm = 0.0;
  for (const Scene& world : worlds) {
    double squares = 0.0;
    for (const float gas_ppm : world.conc_mean_ppm.values()) {
      squares += static_cast<double>(gas_ppm) * static_cast<double>(gas_ppm);
    }
    sum_ppm += std::sqrt(squares / static_cast<double>(world.conc_mean_ppm.size()));
  }
  return sum_ppm / static_cast<double>(worlds.size());
}

std::string SpreadText(const Spread& spread, int digits) {
  return absl::StrFormat("%.*f [± %.*f]", digits, spread.mean, digits, spread.half_95);
}

TextTable MakeTextTable(const SamplingPlan& plan, const Drives& drives) {
  TextTable table;
  table.title = "Means over worlds, of four corners each [95 % interval] (Table II)";
  table.columns = {
      "method",       "distance, m",     "paper", "RMSE convergence time, min", "paper",
      "ours / paper", "sweep's over it", "paper", "whole mission, min",         "final RMSE, ppm"};
  const std::vector<double> sweep_min = MeansByWorld(plan, drives[kSweep], Convergence_min);
  for (std::size_t row = 0; row < kLhrRows.size(); ++row) {
    const auto by = [&](const Figure& figure) { return SpreadBy(plan, drives[row], figure); };
    const Spread convergence_min = by(Convergence_min);
    const PairedRatio sooner =
        PairedRatioOf(sweep_min, MeansByWorld(plan, drives[row], Convergence_min));
    table.rows.push_back(
        {kLhrRows[row].label, SpreadText(by(LhrDriven_m), 0),
         absl::StrFormat("%.0f", kLhrRows[row].paper_distance_m), SpreadText(convergence_min, 1),
         absl::StrFormat("%.1f", kLhrRows[row].paper_convergence_min),
         absl::StrFormat("%.2f", convergence_min.mean / kLhrRows[row].paper_convergence_min),
         absl::StrFormat("%.2f [%.2f, %.2f]", sooner.mean, sooner.low, sooner.high),
         absl::StrFormat(
             "%.2f", kLhrRows[kSweep].paper_convergence_min / kLhrRows[row].paper_convergence_min),
         SpreadText(by(Elapsed_min), 1), SpreadText(by(Final_ppm), 3)});
  }
  return table;
}

TextTable MakeBandTable(const SamplingPlan& plan, const Drives& drives) {
  constexpr double kBands[] = {0.05, 0.01, 0.005, kSteadyShare};
  constexpr double kPercent = 100.0;
  TextTable table;
  table.title = "RMSE convergence time, min, by how near the final value counts as steady";
  table.columns = {"method"};
  for (const double band : kBands) {
    table.columns.push_back(absl::StrFormat("within %.2g %%", kPercent * band));
  }
  table.columns.emplace_back("paper");
  for (std::size_t row = 0; row < kLhrRows.size(); ++row) {
    std::vector<std::string>& cells = table.rows.emplace_back();
    cells = {kLhrRows[row].label};
    for (const double band : kBands) {
      cells.push_back(SpreadText(SpreadBy(plan, drives[row], ConvergenceIn(band)), 1));
    }
    cells.push_back(absl::StrFormat("%.1f", kLhrRows[row].paper_convergence_min));
  }
  return table;
}

void AddNumbers(const SamplingPlan& plan, const Drives& drives, Study& study) {
  auto& figures = study.summary.figures;
  const std::vector<double> sweep_min = MeansByWorld(plan, drives[kSweep], Convergence_min);
  for (std::size_t row = 0; row < kLhrRows.size(); ++row) {
    const std::string name = kLhrRows[row].name;
    const Spread convergence_min = SpreadBy(plan, drives[row], Convergence_min);
    const PairedRatio sooner =
        PairedRatioOf(sweep_min, MeansByWorld(plan, drives[row], Convergence_min));
    figures.emplace_back(name + "_distance_m", SpreadBy(plan, drives[row], LhrDriven_m).mean);
    figures.emplace_back(name + "_rmse_ct_min", convergence_min.mean);
    figures.emplace_back(name + "_rmse_ct_min_half_95", convergence_min.half_95);
    figures.emplace_back(name + "_final_rmse_ppm", SpreadBy(plan, drives[row], Final_ppm).mean);
    study.figures.key_numbers.emplace_back(
        absl::StrCat(kLhrRows[row].label, " converges after"),
        absl::StrFormat("%.0f min (%.1fx)", convergence_min.mean, sooner.mean));
  }
  figures.emplace_back("truth_rms_ppm", TruthRms_ppm(plan.worlds));
}

// The illustrative run, Fig. 2 and 3: the truth, the map after the survey and after some cycles.
absl::Status AddPictures(const ExperimentOptions& options, SamplingPlan plan,
                         ReportFigures& figures) {
  plan.worlds = {MakeLhrScene(LhrTable1Sources())};
  plan.cases = {{"illustrative", 0, plan.cases.front().start, options.seed}};
  plan.judge_period_s = kWholeMission_s;  // after plans alone
  const std::vector<int> pictured = {1, 2, 11, 31, 61};
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<MapPanel> panels,
                              PictureUpdates(plan, kPictured, 0, pictured));
  figures.panels.push_back(TruthPanel(plan.worlds.front()));
  figures.panels.insert(figures.panels.end(), panels.begin(), panels.end());
  return absl::OkStatus();
}

// Fig. 4.
std::vector<Chart> MakeCharts(const SamplingPlan& plan, const Drives& drives) {
  std::vector<NamedDrives> rows;
  for (std::size_t row = kSweep + 1; row < kLhrRows.size(); ++row) {
    rows.push_back({absl::StrCat("Fig. 4, ", kLhrRows[row].label), drives[row]});
  }
  return MakeErrorCharts(plan, {kLhrRows[kSweep].label, drives[kSweep]}, rows);
}

std::vector<std::string> MakeNotes(const SamplingPlan& plan) {
  return {
      absl::StrFormat(
          "The region of the paper, 51 x 51 sites of 1 m, with five leaks drawn around those of "
          "its Table I, and all of its parameters: 5 m/s, 2 s a sample, cycles of 50 s with T = 10 "
          "of M = 15, a survey of every tenth site, of random sampling too. %d drives with each "
          "method, to the last site, in %d worlds. Dashed: 95 %% interval of the mean over worlds.",
          plan.cases.size(), plan.worlds.size()),
      absl::StrFormat(
          "An RMSE has converged from when on it stays within 0.2 %% of its final value. The paper "
          "does not say how near, but its 95.33 min for the sweep are 2600 m at 5 m/s and 2600 "
          "samples of 2 s, and its 202.72 min for random sampling are 34,807 m and 2601 samples: "
          "the whole mission, which no wide band gives. Times hold the survey, in the paper and "
          "here. The variance of readings is proportional to them, as in section II-A."),
      absl::StrFormat(
          "What the paper does not say is ours: how sources are drawn, the plume's formula and "
          "unit, how large the variance of readings is; lambda_p = %g and beta = %g are those that "
          "come nearest to its table in other worlds (lhr_calibration). With every site sampled "
          "the error is what the field smooths away; a map of nothing has %.3f ppm.",
          kLhrUnstated.prior_precision_per_ppm2, kLhrUnstated.beta, TruthRms_ppm(plan.worlds)),
  };
}

}  // namespace

absl::StatusOr<Study> RunLhrTable2(const ExperimentOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(SamplingPlan plan, MakeTablePlan(options));
  plan.progress = options.progress;
  PLUMESCOUT_ASSIGN_OR_RETURN(const Drives drives, RunSamplingStudy(plan));
  Study study;
  study.figures.title = "Low-to-high resolution sampling ([LHR] Table II)";
  study.figures.notes = MakeNotes(plan);
  study.figures.tables = {MakeTextTable(plan, drives), MakeBandTable(plan, drives)};
  study.figures.charts = MakeCharts(plan, drives);
  PLUMESCOUT_RETURN_IF_ERROR(AddPictures(options, plan, study.figures));
  AddNumbers(plan, drives, study);
  PLUMESCOUT_ASSIGN_OR_RETURN(const TourCost cost, MeasureTourCost(options.seed));
  study.summary.figures.emplace_back("p2_3003_subsets_ms", cost.subsets_ms);
  study.summary.figures.emplace_back("p1_6x6_ms", cost.survey_ms);
  AddCalibration(FinalMaps(plan, drives), study);
  study.table = MakeDriveTable(plan, drives);
  study.summary.about = AboutThisRun(options.seed);
  study.summary.about.emplace_back("drives", absl::StrCat(plan.cases.size()));
  study.summary.about.emplace_back("worlds", absl::StrCat(plan.worlds.size()));
  return study;
}

}  // namespace plumescout::lab
