// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/lhr_table2.h"

#include <array>
#include <cstddef>
#include <memory>
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

// Ours. Readings err by a tenth, as section II-A has variances grow with the reading.
constexpr DwellNoise kNoise{0.01, 0.1};
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
  Rgb color;
};
constexpr TableRow kRows[] = {
    {"sweep", "Sweep", "sweep", SamplingReward::kUcb, false, 2601, 95.33, {120, 120, 120}},
    {"random",
     "CRS",
     "random_sampling",
     SamplingReward::kUcb,
     false,
     34807,
     202.72,
     {214, 158, 46}},
    {"mean", "LHR, mean", "lhr", SamplingReward::kMean, true, 15547, 46.71, {36, 99, 201}},
    {"ucb", "LHR, UCB", "lhr", SamplingReward::kUcb, true, 24065, 51.41, {206, 30, 60}},
    {"mean_without",
     "mean, no survey",
     "lhr",
     SamplingReward::kMean,
     false,
     9939,
     78.07,
     {130, 170, 225}},
    {"ucb_without",
     "UCB, no survey",
     "lhr",
     SamplingReward::kUcb,
     false,
     21321,
     49.13,
     {225, 140, 150}},
};
constexpr std::size_t kSweep = 0;
constexpr std::size_t kPictured = 3;  // Fig. 3 is of UCB

absl::StatusOr<StudyRow> MakeRow(const TableRow& row, const Scene& world) {
  PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made, MakeStudyRow(row.name, row.strategy, true));
  made.mission.occupancy.inflation_radius_m = 0.0;  // open, and the robot is a point
  constexpr double kShare = 0.1;
  made.mission.gas.observation_stddev_share = kShare;
  PlanningOptions& planning = made.mission.planning;
  planning.speed_mps = kSpeed_mps;
  planning.dwell_s = kDwell_s;
  const Region region = RegionOf(world.geometry());
  planning.sites.region = Rectangle{region.south_west, region.north_east};
  planning.sites.spacing_m = world.geometry().resolution_m;
  planning.sites.reward = row.reward;
  planning.sites.survey = row.survey;
  planning.sites.survey_stride = kStride;
  planning.sites.candidate_count = kCandidates;
  planning.sites.cycle_sample_count = kCycle;
  planning.sites.update_period_s = kUpdatePeriod_s;
  return made;
}

absl::StatusOr<SamplingPlan> MakePlan(const ExperimentOptions& options) {
  SamplingPlan plan;
  const int worlds = options.trials.value_or(options.quick ? 1 : kWorlds);
  for (int i = 0; i < worlds; ++i) {
    plan.worlds.push_back(MakeLhrScene(LhrScenarioSources(options.seed, i)));
  }
  const std::array<Point2, 4> starts = LhrStarts();
  for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
    for (std::size_t corner = 0; corner < (options.quick ? 1 : starts.size()); ++corner) {
      plan.cases.push_back({absl::StrCat("world_", world, "-corner_", corner),
                            world,
                            {starts[corner].x_m, starts[corner].y_m, 0.0},
                            options.seed + world * starts.size() + corner});
    }
  }
  for (const TableRow& row : kRows) {
    PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made, MakeRow(row, plan.worlds.front()));
    plan.rows.push_back(std::move(made));
  }
  plan.noise = kNoise;
  plan.first_dwell_s = kDwell_s;
  plan.time_limit_s = kTimeLimit_s;
  plan.judge_period_s = kJudgePeriod_s;
  plan.folder = absl::StrCat(options.folder, "/drives");
  plan.jobs = options.jobs;
  plan.progress = options.progress;
  return plan;
}

std::vector<double> Of(const std::vector<SamplingDrive>& drives,
                       double (*value)(const SamplingDrive&)) {
  std::vector<double> values;
  for (const SamplingDrive& drive : drives) values.push_back(value(drive));
  return values;
}
double Driven_m(const SamplingDrive& drive) { return drive.driven_m; }
double Elapsed_min(const SamplingDrive& drive) { return drive.elapsed_s / kSecondsPerMinute; }
double Final_ppm(const SamplingDrive& drive) { return drive.errors.back().rmse_ppm; }
double Convergence_min(const SamplingDrive& drive) {
  return ConvergenceTime_s(drive.errors).value_or(drive.elapsed_s) / kSecondsPerMinute;
}

using Drives = std::vector<std::vector<SamplingDrive>>;

TextTable MakeTextTable(const Drives& drives) {
  TextTable table;
  table.title = "Means over all drives [± 95 % interval] (Table II)";
  table.columns = {"method",         "distance, m",     "paper", "RMSE convergence time, min",
                   "paper",          "sweep's over it", "paper", "whole mission, min",
                   "final RMSE, ppm"};
  const double sweep_min = SpreadOf(Of(drives[kSweep], Convergence_min)).mean;
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    const auto text = [&](double (*value)(const SamplingDrive&), int digits) {
      const Spread spread = SpreadOf(Of(drives[row], value));
      return absl::StrFormat("%.*f [± %.*f]", digits, spread.mean, digits, spread.half_95);
    };
    const double convergence_min = SpreadOf(Of(drives[row], Convergence_min)).mean;
    table.rows.push_back(
        {kRows[row].label, text(Driven_m, 0), absl::StrFormat("%.0f", kRows[row].paper_distance_m),
         text(Convergence_min, 1), absl::StrFormat("%.1f", kRows[row].paper_convergence_min),
         absl::StrFormat("%.2f", sweep_min / convergence_min),
         absl::StrFormat("%.2f",
                         kRows[kSweep].paper_convergence_min / kRows[row].paper_convergence_min),
         text(Elapsed_min, 1), text(Final_ppm, 3)});
  }
  return table;
}

void AddNumbers(const Drives& drives, Study& study) {
  const double sweep_min = SpreadOf(Of(drives[kSweep], Convergence_min)).mean;
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    const std::string name = kRows[row].name;
    const double convergence_min = SpreadOf(Of(drives[row], Convergence_min)).mean;
    study.summary.figures.emplace_back(name + "_distance_m",
                                       SpreadOf(Of(drives[row], Driven_m)).mean);
    study.summary.figures.emplace_back(name + "_convergence_min", convergence_min);
    study.summary.figures.emplace_back(name + "_final_rmse_ppm",
                                       SpreadOf(Of(drives[row], Final_ppm)).mean);
    study.figures.key_numbers.emplace_back(
        absl::StrCat(kRows[row].label, " converges after"),
        absl::StrFormat("%.0f min (%.1fx)", convergence_min, sweep_min / convergence_min));
  }
}

// The illustrative run, Fig. 3: the map after the survey and after some update cycles.
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
Chart MakeErrorChart(const Drives& drives) {
  std::vector<NamedDrives> rows;
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    rows.push_back({kRows[row].label, kRows[row].color, drives[row]});
  }
  return MakeMeanErrorChart(rows, "RMSE over the region, ppm (Fig. 4)");
}

std::vector<std::string> MakeNotes(const SamplingPlan& plan) {
  return {
      absl::StrFormat(
          "The region of the paper, 51 x 51 sites of 1 m, with five leaks drawn around those of "
          "its Table I, and all of its parameters: 5 m/s, 2 s a sample, cycles of 50 s with T = 10 "
          "of M = 15, a survey of every tenth site. %d drives with each method, to the last site.",
          plan.cases.size()),
      "What the paper does not say is ours: how sources are drawn, the plume's formula and unit, "
      "readings that err by a tenth, and when an RMSE has converged: from when on it stays within "
      "5 % of its final value. The paper's times hold the survey, as ours do.",
  };
}

}  // namespace

absl::StatusOr<Study> RunLhrTable2(const ExperimentOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const SamplingPlan plan, MakePlan(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const Drives drives, RunSamplingStudy(plan));
  Study study;
  study.figures.title = "Low-to-high resolution sampling ([LHR] Table II)";
  study.figures.notes = MakeNotes(plan);
  study.figures.tables = {MakeTextTable(drives)};
  study.figures.charts = {MakeErrorChart(drives)};
  PLUMESCOUT_RETURN_IF_ERROR(AddPictures(options, plan, study.figures));
  AddNumbers(drives, study);
  study.table = MakeDriveTable(plan, drives);
  study.summary.about = AboutThisRun(options.seed);
  study.summary.about.emplace_back("drives", absl::StrCat(plan.cases.size()));
  return study;
}

}  // namespace plumescout::lab
