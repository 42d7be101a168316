// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/team_rivals.h"

#include <iterator>
#include <string>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/trials/team_rows.h"
#include "lab/trials/team_tables.h"

namespace plumescout::lab {
namespace {

constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 30.0;

// One robot first: what all are compared with. Rows of team_study have its names, so that their
// trials are not driven again where they are found.
constexpr TeamRow kTeams[] = {
    {.robots = 1, .name = "k1", .label = "1, ours"},
    {.robots = 2, .name = "k2", .label = "2, ours"},
    {.robots = 4, .name = "k4", .label = "4, ours"},
    {.robots = 8, .name = "k8", .label = "8, ours"},
    {.robots = 2, .anticipates = false, .name = "k2_own_prices", .label = "2, claims only"},
    {.robots = 4, .anticipates = false, .name = "k4_own_prices", .label = "4, claims only"},
    {.robots = 8, .anticipates = false, .name = "k8_own_prices", .label = "8, claims only"},
    {.robots = 2,
     .yields = false,
     .anticipates = false,
     .name = "k2_own_ways",
     .label = "2, independent"},
    {.robots = 4,
     .yields = false,
     .anticipates = false,
     .name = "k4_own_ways",
     .label = "4, independent"},
    {.robots = 8,
     .yields = false,
     .anticipates = false,
     .name = "k8_own_ways",
     .label = "8, independent"},
    {.robots = 2,
     .name = "k2_burgard",
     .label = "2, Burgard's discount",
     .rule = TeamRule::kBurgard},
    {.robots = 4,
     .name = "k4_burgard",
     .label = "4, Burgard's discount",
     .rule = TeamRule::kBurgard},
    {.robots = 8,
     .name = "k8_burgard",
     .label = "8, Burgard's discount",
     .rule = TeamRule::kBurgard},
    {.robots = 2,
     .name = "k2_matching",
     .label = "2, matching of frontiers",
     .rule = TeamRule::kMatching},
    {.robots = 4,
     .name = "k4_matching",
     .label = "4, matching of frontiers",
     .rule = TeamRule::kMatching},
    {.robots = 8,
     .name = "k8_matching",
     .label = "8, matching of frontiers",
     .rule = TeamRule::kMatching},
    {.robots = 2,
     .name = "k2_rrt",
     .label = "2, rrt_exploration's rule",
     .rule = TeamRule::kRrtExploration},
    {.robots = 4,
     .name = "k4_rrt",
     .label = "4, rrt_exploration's rule",
     .rule = TeamRule::kRrtExploration},
    {.robots = 8,
     .name = "k8_rrt",
     .label = "8, rrt_exploration's rule",
     .rule = TeamRule::kRrtExploration},
};
// Of quick ones: one robot, and two by each way to choose.
constexpr int kQuickRobots = 2;

constexpr BuildingSize kSizes[] = {
    {"small", "16 to 23 m", {500, 3, "small_building", kSmallBuilding}},
    {"large", "34 to 40 m", {550, 2, "large_building", kLargeBuilding}}};

std::vector<SizeToRun> SizesToRun(const ExperimentOptions& options) {
  std::vector<TeamRow> teams;
  for (const TeamRow& team : kTeams) {
    if (!options.quick || team.robots <= kQuickRobots) teams.push_back(team);
  }
  const double duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  if (!options.scenes.empty()) return {{&kGivenBuildings, teams, duration_s}};
  std::vector<SizeToRun> sizes;
  for (const BuildingSize& size : kSizes) {
    sizes.push_back({&size, teams, duration_s});
    if (options.quick) break;
  }
  return sizes;
}

std::vector<std::string> MakeNotes(double duration_s) {
  return {
      absl::StrFormat("Teams of robots of 0.2 m radius and 1.25 m/s, 0.6 m apart at one door, map "
                      "for %.0f s. Simulation, sensors, followers, starts and seeds are the same "
                      "for all rows; bodies block each other.",
                      duration_s),
      "Sooner by: the time of one robot of ours to a level over the team's, geometric mean over "
      "buildings. The level is 80 % of what that robot gains in its whole run, or 95 % of the map.",
      "Claims only: each robot goes by what its way tells it, and keeps off the goals of others "
      "and "
      "out of their way. Independent: nor does it keep out of their way; but no goal is given to "
      "two.",
      "The other rules choose among occupancy frontiers, by the shortest way on the grid, and keep "
      "out of each other's way like ours; once no frontier is left robots go to the nearest place "
      "whose gas is unobserved. They choose when a robot asks, not all at once. Burgard et al. "
      "2005: utility 1 of each frontier, less 1 - distance / range for each that another drives to "
      "in its sight, less the way there in ranges. Matching: all robots are given frontiers so "
      "that all ways together are shortest, and the one that asks goes. rrt_exploration: three "
      "times the unknown area within a metre, doubled within 3 m of the robot, less the distance.",
  };
}

}  // namespace

absl::StatusOr<Study> RunTeamRivals(const ExperimentOptions& options) {
  Study study;
  study.figures.title = "Teams by the rules of others";
  PLUMESCOUT_RETURN_IF_ERROR(RunSizes(options, SizesToRun(options), [&](const SizeResult& result) {
    if (study.figures.notes.empty()) study.figures.notes = MakeNotes(result.plan.duration_s);
    study.figures.tables.push_back(SpeedTable(result));
    study.figures.tables.push_back(TrafficTable(result));
    AddNumbers(result, study);
    AddCalibration(result, study);
    AddRows(result, study.table);
    return absl::OkStatus();
  }));
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
