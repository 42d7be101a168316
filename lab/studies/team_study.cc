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
#include "lab/formats/scene_folder.h"
#include "lab/report/palette.h"
#include "lab/sim/scene_world.h"
#include "lab/trials/row_figures.h"
#include "lab/trials/study_scenes.h"
#include "lab/trials/team_figures.h"
#include "lab/trials/team_picture.h"
#include "lab/trials/trial_study.h"
#include "lab/worlds/one_lane_layout.h"

namespace plumescout::lab {
namespace {

constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 30.0;
constexpr double kLate_s = 1.0;
constexpr double kTightDuration_s = 120.0;
constexpr int kTightTrials = 10;

struct Team {
  int robots;
  bool yields;       // plans wait for the ways of others
  bool anticipates;  // and leave out what those will tell
  const char* name;
  const char* label;
  Rgb color;
  double most_late_s = 0.0;  // legs fall behind by up to this
  bool ghosts = false;       // robots pass through each other
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
    {4, true, true, "k4_late", "4, up to a second late", {170, 95, 15}, kLate_s},
    {8, true, true, "k8_late", "8, up to a second late", {145, 20, 40}, kLate_s},
    {4, false, true, "k4_ghosts", "4 ghosts", {150, 156, 168}, 0.0, true},
    {8, false, true, "k8_ghosts", "8 ghosts", {107, 114, 128}, 0.0, true},
};
constexpr std::size_t kQuickTeams = 2;
// In buildings that are all doors and lanes for one.
constexpr Team kTightTeams[] = {
    {4, true, true, "k4", "4 robots", {238, 128, 22}},
    {4, true, true, "k4_late", "4, up to a second late", {170, 95, 15}, kLate_s},
};
// What keeping clear of others costs: this row beside that of robots that need not.
struct Pair {
  std::size_t row;
  std::size_t rival;
};
constexpr Pair kClearOrGhosts[] = {{2, 10}, {3, 11}};

// Buildings of one size. None of those with seeds below 600 was looked at while anything was tuned;
// those from 600 on were tuned on.
struct Size {
  const char* name;
  const char* label;
  GeneratedBuildings buildings;
  bool is_tight = false;  // all doors and lanes are for one: do robots get stuck?
};
constexpr GeneratorOptions kSmall = {.min_size_m = 16, .max_size_x_m = 21, .max_size_y_m = 23};
constexpr GeneratorOptions kLarge = {.min_size_m = 34, .max_size_x_m = 40, .max_size_y_m = 40};
constexpr Size kSizes[] = {{"small", "16 to 23 m", {500, 6, "small_building", kSmall}},
                           {"large", "34 to 40 m", {550, 3, "large_building", kLarge}}};
constexpr Size kGiven = {"given", "scenes given", {}};
constexpr Size kTight = {"tight", "doors and lanes of 0.8 m", {580, 10, "one_lane", {}}, true};

// All trials in buildings of one size.
struct SizeResult {
  const Size* size = nullptr;
  std::vector<Team> teams;
  TrialPlan plan;
  std::vector<SceneRecords> records;  // rows as teams
};

absl::StatusOr<TrialPlan> MakePlan(const ExperimentOptions& options, const std::vector<Team>& teams,
                                   std::vector<std::string> scenes) {
  TrialPlan plan;
  for (const Team& team : teams) {
    PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow row,
                                MakeStudyRow(team.name, "plumescout", /*as_the_paper=*/false));
    row.robots = team.robots;
    row.mission.planning.yield_to_robots = team.yields;
    row.mission.planning.anticipate_robots = team.anticipates;
    row.most_late_s = team.most_late_s;
    row.ghosts = team.ghosts;
    plan.rows.push_back(std::move(row));
  }
  plan.scenes = std::move(scenes);
  plan.first_seed = options.seed;
  plan.folder = absl::StrCat(options.folder, "/trials");
  plan.jobs = options.jobs;
  return plan;
}

std::vector<Team> TeamsIn(const Size& size, bool quick) {
  if (size.is_tight) return {std::begin(kTightTeams), std::end(kTightTeams)};
  std::vector<Team> teams(std::begin(kTeams), std::end(kTeams));
  if (quick) teams.resize(kQuickTeams, kTeams[0]);
  return teams;
}

double DurationIn_s(const Size& size, bool quick) {
  if (size.is_tight) return kTightDuration_s;
  return quick ? kQuickDuration_s : kDuration_s;
}

absl::StatusOr<SizeResult> RunSize(const ExperimentOptions& options, const Size& size) {
  constexpr double kScenesShare = 0.2;  // of the time, for the progress line
  ExperimentOptions making = options;
  making.progress = [&options](double share) {
    if (options.progress) options.progress(kScenesShare * share);
  };
  GeneratedBuildings buildings = size.buildings;
  if (options.quick) buildings.count = 1;
  const double duration_s = DurationIn_s(size, options.quick);
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<std::string> scenes,
                              size.is_tight
                                  ? LayoutScenes(making, buildings, OneLaneLayout, duration_s)
                                  : GeneratedScenes(making, buildings, duration_s));
  SizeResult result{&size, TeamsIn(size, options.quick), {}, {}};
  PLUMESCOUT_ASSIGN_OR_RETURN(result.plan, MakePlan(options, result.teams, std::move(scenes)));
  result.plan.trials = options.trials.value_or(size.is_tight ? kTightTrials : 1);
  result.plan.duration_s = duration_s;
  result.plan.progress = [&options](double share) {
    if (options.progress) options.progress(kScenesShare + (1.0 - kScenesShare) * share);
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(result.records, RunTrials(result.plan));
  return result;
}

// What is told of one team beside what it is compared with.
struct RowFigures {
  Speedup speedup;
  Traffic traffic;
  double plan_wall_ratio = 1.0;  // over one robot's
};

RowFigures FiguresOf(const SizeResult& result, std::size_t row) {
  const Traffic traffic = TrafficOf(result.records, row);
  constexpr double kLeast_s = 1e-6;
  const double alone_s = std::max(kLeast_s, TrafficOf(result.records, 0).plan_wall_s);
  return {SpeedupOf(result.records, row, 0), traffic, traffic.plan_wall_s / alone_s};
}

std::string Percent(double share) { return absl::StrFormat("%.1f %%", 100.0 * share); }

TextTable SpeedTable(const SizeResult& result) {
  TextTable table;
  table.title = absl::StrFormat("%d buildings: %s", result.plan.scenes.size(), result.size->label);
  table.columns = {"team",
                   "sooner at 80 % of one robot's gain in entropy",
                   "… in RMSE",
                   "… at 95 % of the map",
                   "runs that did not get there",
                   "promised already",
                   "planned waits, share of time",
                   "plan, ms",
                   "… over one robot's"};
  for (std::size_t row = 0; row < result.teams.size(); ++row) {
    const RowFigures figures = FiguresOf(result, row);
    const Speedup& speedup = figures.speedup;
    constexpr double kMillisecondsPerSecond = 1e3;
    table.rows.push_back(
        {result.teams[row].label, absl::StrFormat("%.2f", speedup.entropy),
         absl::StrFormat("%.2f", speedup.rmse), absl::StrFormat("%.2f", speedup.map),
         absl::StrCat(speedup.censored), Percent(figures.traffic.promised_share()),
         Percent(figures.traffic.waiting_share()),
         absl::StrFormat("%.0f", kMillisecondsPerSecond * figures.traffic.plan_wall_s),
         absl::StrFormat("%.2f", figures.plan_wall_ratio)});
  }
  return table;
}

TextTable TrafficTable(const SizeResult& result) {
  TextTable table;
  table.title = absl::StrFormat("In each other's way: %s, %.0f s", result.size->label,
                                result.plan.duration_s);
  table.columns = {"team",
                   "missions",
                   "contacts",
                   "nearest centres, m",
                   "encounters per robot and minute",
                   "legs blocked",
                   "… by a robot",
                   "goals set aside for that",
                   "rings that lasted 10 s",
                   "… missions with one",
                   "robots without a way past others for 10 s"};
  for (std::size_t row = 0; row < result.teams.size(); ++row) {
    if (result.teams[row].robots == 1) continue;
    const Traffic traffic = TrafficOf(result.records, row);
    const TeamFindings& findings = traffic.sums.findings;
    table.rows.push_back(
        {result.teams[row].label, absl::StrCat(traffic.missions),
         absl::StrCat(traffic.sums.contacts),
         traffic.sums.closest_m ? absl::StrFormat("%.2f", *traffic.sums.closest_m) : "–",
         absl::StrFormat("%.2f", traffic.encounters_per_robot_minute()),
         Percent(traffic.blocked_share()), Percent(traffic.blocked_by_robot_share()),
         absl::StrCat(findings.set_aside_for_robot), absl::StrCat(findings.deadlocks),
         absl::StrCat(traffic.deadlocked_missions), absl::StrCat(findings.held_up)});
  }
  return table;
}

void AddTrafficNumbers(const SizeResult& result, std::size_t row, Study& study) {
  const Traffic traffic = TrafficOf(result.records, row);
  const TeamFindings& findings = traffic.sums.findings;
  const auto add = [&](const char* name, double value) {
    study.summary.figures.emplace_back(
        absl::StrCat(result.size->name, "_", result.teams[row].name, "_", name), value);
  };
  add("missions", traffic.missions);
  add("contacts", traffic.sums.contacts);
  if (traffic.sums.closest_m) add("min_separation_m", *traffic.sums.closest_m);
  add("encounters_per_robot_minute", traffic.encounters_per_robot_minute());
  add("blocked_share", traffic.blocked_share());
  add("blocked_by_robot_share", traffic.blocked_by_robot_share());
  add("set_aside_by_robot", findings.set_aside_for_robot);
  add("deadlocks_unresolved", findings.deadlocks);
  add("deadlocked_missions", traffic.deadlocked_missions);
  add("held_up", findings.held_up);
  add("waiting_share", traffic.waiting_share());
}

void AddNumbers(const SizeResult& result, Study& study) {
  for (std::size_t row = 0; row < result.teams.size(); ++row) {
    const Team& team = result.teams[row];
    const RowFigures figures = FiguresOf(result, row);
    const Speedup& speedup = figures.speedup;
    const auto add = [&](const char* name, double value) {
      study.summary.figures.emplace_back(absl::StrCat(result.size->name, "_", team.name, "_", name),
                                         value);
    };
    add("speedup_entropy80", speedup.entropy);
    add("speedup_rmse80", speedup.rmse);
    add("speedup_complete95", speedup.map);
    add("censored", speedup.censored);
    add("promised_share", figures.traffic.promised_share());
    add("plan_wall_s", figures.traffic.plan_wall_s);
    add("plan_wall_ratio", figures.plan_wall_ratio);
    AddTrafficNumbers(result, row, study);
    if (row == 0 || !team.yields) continue;
    study.figures.key_numbers.emplace_back(
        absl::StrFormat("%s, %s: sooner by", team.label, result.size->label),
        absl::StrFormat("%.1f (entropy), %.1f (map)", speedup.entropy, speedup.map));
  }
}

// How much later teams are that keep clear of each other than teams of ghosts.
void AddCostOfClearance(const SizeResult& result, Study& study) {
  for (const Pair& pair : kClearOrGhosts) {
    if (pair.rival >= result.teams.size()) continue;
    const Speedup sooner = SpeedupOf(result.records, pair.row, pair.rival);
    const double map_share = 1.0 / sooner.map - 1.0;
    const double error_share = 1.0 / sooner.half_rmse - 1.0;
    const int robots = result.teams[pair.row].robots;
    const std::string prefix = absl::StrFormat("%s_k%d_clearance_cost_", result.size->name, robots);
    study.summary.figures.emplace_back(prefix + "complete95_share", map_share);
    study.summary.figures.emplace_back(prefix + "complete95_pairs", sooner.map_pairs);
    study.summary.figures.emplace_back(prefix + "half_rmse_share", error_share);
    study.summary.figures.emplace_back(prefix + "half_rmse_pairs", sooner.half_rmse_pairs);
    study.figures.key_numbers.emplace_back(
        absl::StrFormat("%d robots, %s: later for keeping clear by", robots, result.size->label),
        absl::StrFormat("%s (map, %d of %d pairs reached), %s (half the error, %d of %d)",
                        Percent(map_share), sooner.map_pairs, sooner.pairs, Percent(error_share),
                        sooner.half_rmse_pairs, sooner.pairs));
  }
}

// Four robots, or two if quick, in the first building, for as long as a picture can show.
absl::Status AddPicture(const SizeResult& result, Study& study) {
  constexpr double kPictured_s = 120.0;
  const std::size_t row = std::min<std::size_t>(2, result.teams.size() - 1);
  PLUMESCOUT_ASSIGN_OR_RETURN(Scene scene, ReadScene(result.plan.scenes.front()));
  const SceneWorld world(std::move(scene));
  Trial trial;
  trial.mission = &result.plan.rows[row].mission;
  trial.world = &world;
  trial.robots = result.teams[row].robots;
  trial.seed = result.plan.first_seed;
  trial.duration_s = std::min(kPictured_s, result.plan.duration_s);
  return AddTeamPicture(trial, study.figures);
}

void AddCharts(const SizeResult& result, Study& study) {
  std::vector<RowStyle> styles;
  // The first rows: styles are those of as many.
  for (const Team& team : result.teams) {
    if (!team.anticipates) break;
    styles.push_back({team.label, team.color});
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
      "other in the way only when their beams meet. Up to a second late: in each leg robots fall "
      "behind their trajectories by up to so much, here and there on the way.",
      "Promised already: of what the readings of chosen ways would tell if nobody else read, the "
      "share that live plans of others tell already, as missions foresee them. Blocked by a robot: "
      "another body was within 1.5 m when the leg ended so. Rings: robots that wait for each "
      "other, "
      "found once a second. Ghosts neither see each other nor run into each other: later for "
      "keeping clear is beside them, in the time to 95 % of the map and to half of the first "
      "error. Pairs reached: both got there, a run and that of its ghosts. Who did not counts with "
      "the end of the run, so where few did the cost says nothing.",
  };
}

std::string MakeTightNote(const TrialPlan& plan) {
  return absl::StrFormat(
      "Doors and lanes of 0.8 m: %d drawn buildings of dead-end rooms on a corridor, in which two "
      "robots cannot pass each other in any door or lane; %d missions of %.0f s in each for every "
      "row. Robots start near each other in one of the rooms. There is no row of one robot, and "
      "how fast they are is not compared: only whether they get stuck.",
      plan.scenes.size(), plan.trials, plan.duration_s);
}

}  // namespace

absl::StatusOr<Study> RunTeamStudy(const ExperimentOptions& options) {
  Study study;
  study.figures.title = "Robots that share a mission";
  const bool given = !options.scenes.empty();
  std::vector<Size> sizes(std::begin(kSizes), std::end(kSizes));
  if (given) sizes = {kGiven};
  if (options.quick) sizes.resize(1);
  const bool with_tight = !given && !options.quick;
  const double of_all = 1.0 / static_cast<double>(sizes.size() + (with_tight ? 1 : 0));
  const auto part_of = [&](std::size_t i) {
    ExperimentOptions part = options;
    part.progress = [&options, i, of_all](double share) {
      if (options.progress) options.progress(of_all * (static_cast<double>(i) + share));
    };
    return part;
  };
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const SizeResult result, RunSize(part_of(i), sizes[i]));
    if (i == 0) {
      study.figures.notes = MakeNotes(result.plan, given);
      PLUMESCOUT_RETURN_IF_ERROR(AddPicture(result, study));
    }
    study.figures.tables.push_back(SpeedTable(result));
    study.figures.tables.push_back(TrafficTable(result));
    AddCharts(result, study);
    AddNumbers(result, study);
    AddCostOfClearance(result, study);
    AddRows(result, study.table);
  }
  if (with_tight) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const SizeResult result, RunSize(part_of(sizes.size()), kTight));
    study.figures.tables.push_back(TrafficTable(result));
    study.figures.notes.push_back(MakeTightNote(result.plan));
    for (std::size_t row = 0; row < result.teams.size(); ++row) {
      AddTrafficNumbers(result, row, study);
    }
    AddRows(result, study.table);
  }
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
