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
#include "lab/trials/convergence.h"
#include "lab/trials/sampling_pictures.h"
#include "lab/trials/sampling_study.h"
#include "lab/trials/statistics.h"
#include "lab/trials/tour_cost.h"
#include "lab/worlds/lhr_scene.h"

namespace plumescout::lab {
namespace {

// [LHR] section IV-A.
constexpr double kSpeed_mps = 5.0;
constexpr double kDwell_s = 2.0;
constexpr double kUpdatePeriod_s = 50.0;
constexpr int kStride = 10;      // alpha
constexpr int kCandidates = 15;  // M
constexpr int kCycle = 10;       // T

// Section II-A: the variance of a reading is proportional to it. By how much is ours: one standard
// deviation is 1 ppm at 10 ppm; and readings below 1 ppm count as of 1 ppm.
constexpr DwellNoise kNoise{
    .sigma_ppm = 0.01, .share = 0.0, .variance_per_ppm = 0.1, .least_told_ppm2 = 0.1};
// lambda_p, of which the paper says nothing: [XIT] Table I has 3, [IPP] section IV 0.5.
constexpr double kPriorPrecision = 3.0;
constexpr double kScannedPriors[] = {0.1, 0.5, 3.0, 10.0};
constexpr std::uint64_t kScanSeed = 1000;  // of a world beside those of the tables
constexpr int kWorlds = 5;
constexpr double kTimeLimit_s = 50'000.0;  // all rows end long before
constexpr double kJudgePeriod_s = 10.0;
constexpr double kSecondsPerMinute = 60.0;

struct TableRow {
  const char* name;
  const char* label;
  const char* strategy;
  SamplingReward reward;
  bool survey;
  double paper_distance_m;       // Table II
  double paper_convergence_min;  // Table II
};
constexpr TableRow kRows[] = {
    {"sweep", "Sweep", "sweep", SamplingReward::kUcb, false, 2601, 95.33},
    {"crs", "CRS", "random_sampling", SamplingReward::kUcb, true, 34807, 202.72},
    {"lhr_mean", "LHR, mean", "lhr", SamplingReward::kMean, true, 15547, 46.71},
    {"lhr_ucb", "LHR, UCB", "lhr", SamplingReward::kUcb, true, 24065, 51.41},
    {"lhr_mean_no_survey", "mean, no survey", "lhr", SamplingReward::kMean, false, 9939, 78.07},
    {"lhr_ucb_no_survey", "UCB, no survey", "lhr", SamplingReward::kUcb, false, 21321, 49.13},
};
constexpr std::size_t kSweep = 0;
constexpr std::size_t kPictured = 3;  // Fig. 3 is of UCB

absl::StatusOr<StudyRow> MakeRow(const TableRow& row, const Scene& world, double prior_precision) {
  PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made, MakeStudyRow(row.name, row.strategy, true));
  made.mission.occupancy.inflation_radius_m = 0.0;  // open, and the robot is a point
  made.mission.gas.prior_precision_per_ppm2 = prior_precision;
  PlanningOptions& planning = made.mission.planning;
  planning.speed_mps = kSpeed_mps;
  planning.dwell_s = kDwell_s;
  planning.sites.region = RegionOf(world.geometry());
  planning.sites.spacing_m = world.geometry().resolution_m;
  planning.sites.reward = row.reward;
  planning.sites.survey = row.survey;
  planning.sites.survey_stride = kStride;
  planning.sites.candidate_count = kCandidates;
  planning.sites.cycle_sample_count = kCycle;
  planning.sites.update_period_s = kUpdatePeriod_s;
  return made;
}

// Drives of every row, with this lambda_p, from `corners` corners of the worlds.
absl::StatusOr<SamplingPlan> MakePlan(const ExperimentOptions& options, std::vector<Scene> worlds,
                                      std::size_t corners, double prior_precision) {
  SamplingPlan plan;
  plan.worlds = std::move(worlds);
  const std::array<Point2, 4> starts = LhrStarts();
  for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
    for (std::size_t corner = 0; corner < corners; ++corner) {
      plan.cases.push_back({absl::StrCat("world_", world, "-corner_", corner),
                            world,
                            {starts[corner].x_m, starts[corner].y_m, 0.0},
                            options.seed + world * starts.size() + corner});
    }
  }
  for (const TableRow& row : kRows) {
    PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made, MakeRow(row, plan.worlds.front(), prior_precision));
    plan.rows.push_back(std::move(made));
  }
  plan.noise = kNoise;
  plan.first_dwell_s = kDwell_s;
  plan.time_limit_s = kTimeLimit_s;
  plan.judge_period_s = kJudgePeriod_s;
  plan.folder = absl::StrCat(options.folder, "/drives");
  plan.jobs = options.jobs;
  return plan;
}

absl::StatusOr<SamplingPlan> MakeTablePlan(const ExperimentOptions& options) {
  const int count = options.trials.value_or(options.quick ? 1 : kWorlds);
  std::vector<Scene> worlds;
  for (int i = 0; i < count; ++i) {
    worlds.push_back(MakeLhrScene(LhrScenarioSources(options.seed, i)));
  }
  return MakePlan(options, std::move(worlds), options.quick ? 1 : LhrStarts().size(),
                  kPriorPrecision);
}

using Drives = std::vector<std::vector<SamplingDrive>>;
using Figure = std::function<double(const SamplingDrive&)>;

double Driven_m(const SamplingDrive& drive) { return drive.driven_m; }
double Elapsed_min(const SamplingDrive& drive) { return drive.elapsed_s / kSecondsPerMinute; }
double Final_ppm(const SamplingDrive& drive) { return drive.errors.back().rmse_ppm; }
Figure ConvergenceIn(double band) {
  return [band](const SamplingDrive& drive) {
    return ConvergenceTime_s(drive.errors, band).value_or(drive.elapsed_s) / kSecondsPerMinute;
  };
}
double Convergence_min(const SamplingDrive& drive) { return ConvergenceIn(kSteadyShare)(drive); }

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
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    const auto by = [&](const Figure& figure) { return SpreadBy(plan, drives[row], figure); };
    const Spread convergence_min = by(Convergence_min);
    const PairedRatio sooner =
        PairedRatioOf(sweep_min, MeansByWorld(plan, drives[row], Convergence_min));
    table.rows.push_back(
        {kRows[row].label, SpreadText(by(Driven_m), 0),
         absl::StrFormat("%.0f", kRows[row].paper_distance_m), SpreadText(convergence_min, 1),
         absl::StrFormat("%.1f", kRows[row].paper_convergence_min),
         absl::StrFormat("%.2f", convergence_min.mean / kRows[row].paper_convergence_min),
         absl::StrFormat("%.2f [%.2f, %.2f]", sooner.mean, sooner.low, sooner.high),
         absl::StrFormat("%.2f",
                         kRows[kSweep].paper_convergence_min / kRows[row].paper_convergence_min),
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
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    std::vector<std::string>& cells = table.rows.emplace_back();
    cells = {kRows[row].label};
    for (const double band : kBands) {
      cells.push_back(SpreadText(SpreadBy(plan, drives[row], ConvergenceIn(band)), 1));
    }
    cells.push_back(absl::StrFormat("%.1f", kRows[row].paper_convergence_min));
  }
  return table;
}

// All rows from one corner of one world beside those of the tables, with several lambda_p.
absl::StatusOr<TextTable> ScanPriors(const ExperimentOptions& options,
                                     const std::function<void(double)>& progress) {
  TextTable table;
  table.title = "RMSE convergence time, min, by λ_p: one corner of a world of its own";
  table.columns = {"λ_p, 1 / ppm²"};
  for (const TableRow& row : kRows) table.columns.emplace_back(row.label);
  table.columns.insert(table.columns.end(), {"final RMSE, ppm", "map of nothing, ppm"});
  const std::vector<Scene> worlds = {MakeLhrScene(LhrScenarioSources(options.seed + kScanSeed, 0))};
  for (std::size_t i = 0; i < std::size(kScannedPriors); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(SamplingPlan plan, MakePlan(options, worlds, 1, kScannedPriors[i]));
    plan.folder = absl::StrCat(options.folder, "/scan_", i);
    plan.progress = [&progress, i](double share) {
      progress((static_cast<double>(i) + share) / static_cast<double>(std::size(kScannedPriors)));
    };
    PLUMESCOUT_ASSIGN_OR_RETURN(const Drives drives, RunSamplingStudy(plan));
    std::vector<std::string>& cells = table.rows.emplace_back();
    cells = {absl::StrFormat("%g", kScannedPriors[i])};
    for (const std::vector<SamplingDrive>& row : drives) {
      cells.push_back(absl::StrFormat("%.1f", Convergence_min(row.front())));
    }
    cells.push_back(absl::StrFormat("%.3f", Final_ppm(drives[kSweep].front())));
    cells.push_back(absl::StrFormat("%.3f", TruthRms_ppm(worlds)));
  }
  return table;
}

void AddNumbers(const SamplingPlan& plan, const Drives& drives, Study& study) {
  auto& figures = study.summary.figures;
  const std::vector<double> sweep_min = MeansByWorld(plan, drives[kSweep], Convergence_min);
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    const std::string name = kRows[row].name;
    const Spread convergence_min = SpreadBy(plan, drives[row], Convergence_min);
    const PairedRatio sooner =
        PairedRatioOf(sweep_min, MeansByWorld(plan, drives[row], Convergence_min));
    figures.emplace_back(name + "_distance_m", SpreadBy(plan, drives[row], Driven_m).mean);
    figures.emplace_back(name + "_rmse_ct_min", convergence_min.mean);
    figures.emplace_back(name + "_rmse_ct_min_half_95", convergence_min.half_95);
    figures.emplace_back(name + "_final_rmse_ppm", SpreadBy(plan, drives[row], Final_ppm).mean);
    study.figures.key_numbers.emplace_back(
        absl::StrCat(kRows[row].label, " converges after"),
        absl::StrFormat("%.0f min (%.1fx)", convergence_min.mean, sooner.mean));
  }
  figures.emplace_back("truth_rms_ppm", TruthRms_ppm(plan.worlds));
}

// The illustrative run, Fig. 2 and 3: the truth, the map after the survey and after some cycles.
absl::Status AddPictures(const ExperimentOptions& options, SamplingPlan plan,
                         ReportFigures& figures) {
  plan.worlds = {MakeLhrScene(LhrTable1Sources())};
  plan.cases = {{"illustrative", 0, plan.cases.front().start, options.seed}};
  plan.judge_period_s = kTimeLimit_s;  // after plans alone
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
  for (std::size_t row = kSweep + 1; row < std::size(kRows); ++row) {
    rows.push_back({absl::StrCat("Fig. 4, ", kRows[row].label), drives[row]});
  }
  return MakeErrorCharts(plan, {kRows[kSweep].label, drives[kSweep]}, rows);
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
          "unit, how large the variance of readings is, lambda_p = %g and lambda_o = 10 of [XIT]. "
          "With every site sampled the error is what the field smooths away; a map of nothing "
          "has %.3f ppm.",
          kPriorPrecision, TruthRms_ppm(plan.worlds)),
  };
}

}  // namespace

absl::StatusOr<Study> RunLhrTable2(const ExperimentOptions& options) {
  const double table_share = options.quick ? 1.0 : 0.8;  // of the time, for the progress line
  PLUMESCOUT_ASSIGN_OR_RETURN(SamplingPlan plan, MakeTablePlan(options));
  plan.progress = PartOfProgress(options, 0.0, table_share);
  PLUMESCOUT_ASSIGN_OR_RETURN(const Drives drives, RunSamplingStudy(plan));
  Study study;
  study.figures.title = "Low-to-high resolution sampling ([LHR] Table II)";
  study.figures.notes = MakeNotes(plan);
  study.figures.tables = {MakeTextTable(plan, drives), MakeBandTable(plan, drives)};
  if (!options.quick) {
    PLUMESCOUT_ASSIGN_OR_RETURN(TextTable scan,
                                ScanPriors(options, PartOfProgress(options, table_share, 1.0)));
    study.figures.tables.push_back(std::move(scan));
  }
  study.figures.charts = MakeCharts(plan, drives);
  PLUMESCOUT_RETURN_IF_ERROR(AddPictures(options, plan, study.figures));
  AddNumbers(plan, drives, study);
  PLUMESCOUT_ASSIGN_OR_RETURN(const TourCost cost, MeasureTourCost(options.seed));
  study.summary.figures.emplace_back("p2_3003_subsets_ms", cost.subsets_ms);
  study.summary.figures.emplace_back("p1_6x6_ms", cost.survey_ms);
  study.table = MakeDriveTable(plan, drives);
  study.summary.about = AboutThisRun(options.seed);
  study.summary.about.emplace_back("drives", absl::StrCat(plan.cases.size()));
  study.summary.about.emplace_back("worlds", absl::StrCat(plan.worlds.size()));
  return study;
}

}  // namespace plumescout::lab
