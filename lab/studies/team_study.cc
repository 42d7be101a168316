// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/team_study.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/formats/scene_folder.h"
#include "lab/sim/scene_world.h"
#include "lab/trials/row_figures.h"
#include "lab/trials/team_figures.h"
#include "lab/trials/team_picture.h"
#include "lab/trials/team_rows.h"
#include "lab/trials/team_tables.h"

namespace plumescout::lab {
namespace {

constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 30.0;
constexpr double kLate_s = 1.0;
constexpr double kTightDuration_s = 120.0;
constexpr int kTightTrials = 10;

// One robot first: what the others are compared with.
constexpr TeamRow kTeams[] = {
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
    {4, true, true, "k4_areas", "4, each its own area", {90, 80, 200}, 0.0, false, {}, true},
    {8, true, true, "k8_areas", "8, each its own area", {60, 40, 150}, 0.0, false, {}, true},
};
constexpr std::size_t kQuickTeams = 2;
// In buildings that are all doors and lanes for one.
constexpr TeamRow kTightTeams[] = {
    {4, true, true, "k4", "4 robots", {238, 128, 22}},
    {4, true, true, "k4_late", "4, up to a second late", {170, 95, 15}, kLate_s},
};
// What keeping clear of others costs: this row beside that of robots that need not.
struct Pair {
  std::size_t row;
  std::size_t rival;
};
constexpr Pair kClearOrGhosts[] = {{2, 10}, {3, 11}};

constexpr BuildingSize kSizes[] = {
    {"small", "16 to 23 m", {506, 6, "small_building", kSmallBuilding}},
    {"large", "34 to 40 m", {550, 3, "large_building", kLargeBuilding}}};
constexpr BuildingSize kTight = {
    "tight", "doors and lanes of 0.8 m", {580, 10, "one_lane", {}}, true};

std::vector<SizeToRun> SizesToRun(const ExperimentOptions& options) {
  std::vector<TeamRow> teams(std::begin(kTeams), std::end(kTeams));
  if (options.quick) teams.resize(kQuickTeams);
  const double duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  if (!options.scenes.empty()) return {{&kGivenBuildings, teams, duration_s}};
  std::vector<SizeToRun> sizes;
  for (const BuildingSize& size : kSizes) sizes.push_back({&size, teams, duration_s});
  if (options.quick) {
    sizes.resize(1);
  } else {
    const std::vector<TeamRow> tight(std::begin(kTightTeams), std::end(kTightTeams));
    sizes.push_back({&kTight, tight, kTightDuration_s, kTightTrials});
  }
  return sizes;
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
  for (const TeamRow& team : result.teams) {
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
      "behind their trajectories by up to so much, here and there on the way. Each its own area: "
      "planning.balanced_areas is on.",
      "Promised already: of what the readings of chosen ways would tell if nobody else read, the "
      "share that live plans of others tell already, as missions foresee them. Bought twice: of "
      "what these ways were priced at when they were chosen, the share above what they tell beside "
      "those plans; what is promised already and not paid for is no part of it. Edges of the "
      "unseen: of the ways that were chosen to one, the share whose edge live plans of others are "
      "to see, within the range of the lidar and past no wall; bought twice with these included, "
      "as "
      "if others were to see all that hides there.",
      "Blocked by a robot: another body was within 1.5 m when the leg ended so. Rings: robots that "
      "wait for each other, found once a second. Ghosts neither see each other nor run into each "
      "other: later for keeping clear is beside them, in the time to 95 % of the map and to half "
      "of the first error. Pairs reached: both got there, a run and that of its ghosts. Who did "
      "not counts with the end of the run, so where few did the cost says nothing.",
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

void AddTight(const SizeResult& result, Study& study) {
  study.figures.tables.push_back(TrafficTable(result));
  study.figures.notes.push_back(MakeTightNote(result.plan));
  for (std::size_t row = 0; row < result.teams.size(); ++row) {
    AddTrafficNumbers(result, row, study);
  }
}

void AddSize(const SizeResult& result, Study& study) {
  study.figures.tables.push_back(SpeedTable(result));
  study.figures.tables.push_back(TrafficTable(result));
  AddCharts(result, study);
  AddNumbers(result, study);
  AddCostOfClearance(result, study);
}

}  // namespace

absl::StatusOr<Study> RunTeamStudy(const ExperimentOptions& options) {
  Study study;
  study.figures.title = "Robots that share a mission";
  PLUMESCOUT_RETURN_IF_ERROR(
      RunSizes(options, SizesToRun(options), [&](const SizeResult& result) -> absl::Status {
        if (study.figures.notes.empty()) {
          study.figures.notes = MakeNotes(result.plan, !options.scenes.empty());
          PLUMESCOUT_RETURN_IF_ERROR(AddPicture(result, study));
        }
        if (result.size->is_tight) {
          AddTight(result, study);
        } else {
          AddSize(result, study);
        }
        AddCalibration(result, study);
        AddRows(result, study.table);
        return absl::OkStatus();
      }));
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
