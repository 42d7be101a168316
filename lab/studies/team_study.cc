// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/team_study.h"

#include <algorithm>
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
#include "lab/trials/team_times.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {
namespace {

constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 40.0;
constexpr double kShareOfGain = 0.8;
constexpr double kMostOfTheMap = 0.95;

struct Team {
  int robots;
  bool yields;       // plans wait for the ways of others
  bool anticipates;  // and leave out what those will tell
  const char* name;
  const char* label;
  Rgb color;
};
// One robot first: what the others are compared with.
constexpr Team kTeams[] = {
    {1, true, true, "k1", "1 robot", {36, 99, 201}},
    {2, true, true, "k2", "2 robots", {20, 130, 90}},
    {4, true, true, "k4", "4 robots", {238, 128, 22}},
    {8, true, true, "k8", "8 robots", {206, 30, 60}},
    {4, true, false, "k4_own_prices", "4, each its own price", {240, 160, 70}},
    {8, true, false, "k8_own_prices", "8, each its own price", {220, 85, 110}},
    {4, false, false, "k4_own_ways", "4, each its own way and price", {245, 190, 120}},
    {8, false, false, "k8_own_ways", "8, each its own way and price", {235, 140, 160}},
};
constexpr int kQuickTeams = 2;

// Buildings of one size. Those with seeds of 600 and more were tuned on.
struct Size {
  const char* name;
  const char* label;
  GeneratedBuildings buildings;
};
constexpr GeneratorOptions kSmall = {.min_size_m = 16, .max_size_x_m = 21, .max_size_y_m = 23};
constexpr GeneratorOptions kLarge = {.min_size_m = 34, .max_size_x_m = 40, .max_size_y_m = 40};
constexpr Size kSizes[] = {{"small", "16 to 23 m", {500, 6, "small_building", kSmall}},
                           {"large", "34 to 40 m", {550, 3, "large_building", kLarge}}};
constexpr Size kGiven = {"given", "scenes given", {}};

// All trials in buildings of one size.
struct SizeResult {
  const Size* size = nullptr;
  TrialPlan plan;
  std::vector<SceneRecords> records;  // rows as kTeams
};

absl::StatusOr<TrialPlan> MakePlan(const ExperimentOptions& options,
                                   std::vector<std::string> scenes) {
  TrialPlan plan;
  for (const Team& team : kTeams) {
    if (options.quick && plan.rows.size() == kQuickTeams) break;
    PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow row,
                                MakeStudyRow(team.name, "plumescout", /*as_the_paper=*/false));
    row.robots = team.robots;
    row.mission.planning.yield_to_robots = team.yields;
    row.mission.planning.anticipate_robots = team.anticipates;
    plan.rows.push_back(std::move(row));
  }
  plan.scenes = std::move(scenes);
  plan.trials = options.trials.value_or(1);
  plan.first_seed = options.seed;
  plan.duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  plan.folder = absl::StrCat(options.folder, "/trials");
  plan.jobs = options.jobs;
  return plan;
}

absl::StatusOr<SizeResult> RunSize(const ExperimentOptions& options, const Size& size) {
  constexpr double kScenesShare = 0.2;  // of the time, for the progress line
  ExperimentOptions making = options;
  making.progress = [&options](double share) {
    if (options.progress) options.progress(kScenesShare * share);
  };
  GeneratedBuildings buildings = size.buildings;
  if (options.quick) buildings.count = 1;
  const double duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<std::string> scenes,
                              GeneratedScenes(making, buildings, duration_s));
  SizeResult result{&size, {}, {}};
  PLUMESCOUT_ASSIGN_OR_RETURN(result.plan, MakePlan(options, std::move(scenes)));
  result.plan.progress = [&options](double share) {
    if (options.progress) options.progress(kScenesShare + (1.0 - kScenesShare) * share);
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(result.records, RunTrials(result.plan));
  return result;
}

// Times of all trials of one row over those of the same trials with one robot.
struct Speedup {
  double entropy = 1.0;  // to 80 % of what one robot gains; geometric means
  double rmse = 1.0;
  double map = 1.0;  // to 95 %
  int censored = 0;  // runs of the row that did not get to one of the three
};

Speedup SpeedupOf(const std::vector<SceneRecords>& records, std::size_t row) {
  std::vector<double> ratios[3];
  Speedup speedup;
  constexpr MetricFn kFalling[] = {EntropyPerCell_nats, Rmse_ppm};
  for (const SceneRecords& scene : records) {
    for (std::size_t k = 0; k < scene[row].size(); ++k) {
      const std::vector<CurvePoint>& alone = scene[0][k].curve;
      const std::vector<CurvePoint>& team = scene[row][k].curve;
      bool reached = true;
      const auto compare = [&](std::size_t figure, const ReachedAt& a, const ReachedAt& b) {
        constexpr double kLeast_s = 1.0;
        ratios[figure].push_back(std::max(kLeast_s, a.time_s) / std::max(kLeast_s, b.time_s));
        reached = reached && b.reached;
      };
      for (std::size_t i = 0; i < std::size(kFalling); ++i) {
        const double level = LevelAtShare(alone, kFalling[i], kShareOfGain);
        compare(i, FallsTo(alone, kFalling[i], level), FallsTo(team, kFalling[i], level));
      }
      compare(2, RisesTo(alone, Completeness, kMostOfTheMap),
              RisesTo(team, Completeness, kMostOfTheMap));
      if (!reached) ++speedup.censored;
    }
  }
  speedup.entropy = GeometricMean(ratios[0]);
  speedup.rmse = GeometricMean(ratios[1]);
  speedup.map = GeometricMean(ratios[2]);
  return speedup;
}

// Sums over all trials of a row.
struct Traffic {
  TeamRecord sums;
  double plan_wall_s = 0.0;  // mean of medians

  double blocked_share() const {
    return static_cast<double>(sums.blocked_legs) / std::max(1, sums.legs);
  }
  double encounters_per_robot_minute() const {
    constexpr double kSecondsPerMinute = 60.0;
    return kSecondsPerMinute * sums.encounters / std::max(1.0, sums.robot_s);
  }
  double waiting_share() const { return sums.waiting_s / std::max(1.0, sums.robot_s); }
};

Traffic TrafficOf(const std::vector<SceneRecords>& records, std::size_t row) {
  Traffic traffic;
  std::vector<double> walls_s;
  for (const SceneRecords& scene : records) {
    for (const TrialRecord& trial : scene[row]) {
      TeamRecord& sums = traffic.sums;
      const bool is_first = walls_s.empty();
      sums.legs += trial.team.legs;
      sums.blocked_legs += trial.team.blocked_legs;
      sums.contacts += trial.team.contacts;
      sums.encounters += trial.team.encounters;
      sums.waiting_s += trial.team.waiting_s;
      sums.robot_s += trial.team.robot_s;
      sums.closest_m =
          is_first ? trial.team.closest_m : std::min(sums.closest_m, trial.team.closest_m);
      walls_s.push_back(trial.team.plan_wall_s);
    }
  }
  traffic.plan_wall_s = SpreadOf(walls_s).mean;
  return traffic;
}

TextTable MakeTextTable(const SizeResult& result) {
  TextTable table;
  table.title = absl::StrFormat("%d buildings: %s", result.plan.scenes.size(), result.size->label);
  table.columns = {"team",
                   "sooner at 80 % of one robot's gain in entropy",
                   "… in RMSE",
                   "… at 95 % of the map",
                   "runs that did not get there",
                   "contacts",
                   "nearest, m",
                   "encounters per robot and minute",
                   "legs blocked",
                   "planned waits, share of time",
                   "plan, ms"};
  for (std::size_t row = 0; row < result.plan.rows.size(); ++row) {
    const Speedup speedup = SpeedupOf(result.records, row);
    const Traffic traffic = TrafficOf(result.records, row);
    constexpr double kPercent = 100.0;
    constexpr double kMillisecondsPerSecond = 1e3;
    table.rows.push_back({kTeams[row].label, absl::StrFormat("%.2f", speedup.entropy),
                          absl::StrFormat("%.2f", speedup.rmse),
                          absl::StrFormat("%.2f", speedup.map), absl::StrCat(speedup.censored),
                          absl::StrCat(traffic.sums.contacts),
                          row == 0 ? "–" : absl::StrFormat("%.2f", traffic.sums.closest_m),
                          absl::StrFormat("%.2f", traffic.encounters_per_robot_minute()),
                          absl::StrFormat("%.0f %%", kPercent * traffic.blocked_share()),
                          absl::StrFormat("%.1f %%", kPercent * traffic.waiting_share()),
                          absl::StrFormat("%.0f", kMillisecondsPerSecond * traffic.plan_wall_s)});
  }
  return table;
}

void AddNumbers(const SizeResult& result, Study& study) {
  for (std::size_t row = 0; row < result.plan.rows.size(); ++row) {
    const Speedup speedup = SpeedupOf(result.records, row);
    const Traffic traffic = TrafficOf(result.records, row);
    const std::string prefix = absl::StrCat(result.size->name, "_", kTeams[row].name);
    const auto add = [&](const char* name, double value) {
      study.summary.figures.emplace_back(absl::StrCat(prefix, "_", name), value);
    };
    add("speedup_entropy80", speedup.entropy);
    add("speedup_rmse80", speedup.rmse);
    add("speedup_complete95", speedup.map);
    add("censored", speedup.censored);
    add("contacts", traffic.sums.contacts);
    add("min_separation_m", traffic.sums.closest_m);
    add("encounters_per_robot_minute", traffic.encounters_per_robot_minute());
    add("blocked_share", traffic.blocked_share());
    add("waiting_share", traffic.waiting_share());
    add("plan_wall_s", traffic.plan_wall_s);
    if (row == 0 || !kTeams[row].yields) continue;
    study.figures.key_numbers.emplace_back(
        absl::StrFormat("%s, %s: sooner by", kTeams[row].label, result.size->label),
        absl::StrFormat("%.1f (entropy), %.1f (map)", speedup.entropy, speedup.map));
  }
}

void AddCharts(const SizeResult& result, Study& study) {
  std::vector<RowStyle> styles;
  for (std::size_t row = 0; row < result.plan.rows.size(); ++row) {
    if (kTeams[row].anticipates) styles.push_back({kTeams[row].label, kTeams[row].color});
  }
  const auto add = [&](const char* title, MetricFn metric) {
    study.figures.charts.push_back(MakeMetricChart(
        result.records, styles, absl::StrCat(title, ": ", result.size->label), metric));
  };
  add("Entropy, nats per critical cell", EntropyPerCell_nats);
  add("Completeness", Completeness);
}

void AddRows(const SizeResult& result, CsvTable& table) {
  CsvTable part = MakeTrialTable(result.plan, result.records);
  table.label_columns = part.label_columns;
  table.columns = part.columns;
  std::move(part.labels.begin(), part.labels.end(), std::back_inserter(table.labels));
  std::move(part.rows.begin(), part.rows.end(), std::back_inserter(table.rows));
}

std::vector<std::string> MakeNotes(const TrialPlan& plan, bool given) {
  return {
      absl::StrFormat("Teams of robots of 0.2 m radius and 1.25 m/s, 0.6 m apart at one door, map "
                      "for %.0f s with the strategy plumescout, planned in turn as they ask. They "
                      "follow their trajectories exactly; bodies block each other, and two that "
                      "run into each other stand for a second.%s",
                      plan.duration_s, given ? "" : " None of the buildings was used for tuning."),
      "Sooner by: one robot's time to a level over the team's, geometric mean over buildings. The "
      "level is 80 % of what one robot gains in its whole run, and a time counts from when the "
      "level is kept. A run that does not get there counts with its duration.",
      "Each its own price: planning.anticipate_robots is off, so what others are about to tell is "
      "paid for again. Each its own way: planning.yield_to_robots is off too, so robots find each "
      "other in the way only when their beams meet.",
  };
}

}  // namespace

absl::StatusOr<Study> RunTeamStudy(const ExperimentOptions& options) {
  Study study;
  study.figures.title = "Robots that share a mission";
  const bool given = !options.scenes.empty();
  std::vector<Size> sizes(std::begin(kSizes), std::end(kSizes));
  if (given) sizes = {kGiven};
  if (options.quick) sizes.resize(1);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double of_all = 1.0 / static_cast<double>(sizes.size());
    ExperimentOptions part = options;
    part.progress = [&options, i, of_all](double share) {
      if (options.progress) options.progress(of_all * (static_cast<double>(i) + share));
    };
    PLUMESCOUT_ASSIGN_OR_RETURN(const SizeResult result, RunSize(part, sizes[i]));
    if (study.figures.notes.empty()) study.figures.notes = MakeNotes(result.plan, given);
    study.figures.tables.push_back(MakeTextTable(result));
    AddCharts(result, study);
    AddNumbers(result, study);
    AddRows(result, study.table);
  }
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
