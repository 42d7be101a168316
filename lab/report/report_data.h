// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/map_snapshot.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "lab/report/objective_section.h"
#include "lab/report/team_panels.h"

namespace plumescout::lab {

// How good the map was at one instant. A value that is not finite was not measured.
struct MetricPoint {
  double time_s = 0.0;
  double completeness = 0.0;   // known-free share of the true reachable free cells, [0, 1]
  double rmse_ppm = 0.0;       // over critical cells, [XIT] Eq. (23)
  double rmse_zero_ppm = 0.0;  // of a map that says 0 everywhere: the line to beat
  double entropy_nats = 0.0;   // over critical cells, [XIT] Eq. (24)
};

// What a report of one mission shows.
struct ReportData {
  std::string title;
  std::optional<Grid<float>> true_gas_ppm;        // with the geometry of `truth`
  Grid<CellState> truth;                          // true occupancy; may be empty if nobody knows it
  MapSnapshot map;                                // at the end of the mission
  std::vector<std::vector<Point2>> driven_paths;  // one per robot
  std::vector<Plan> plans;                        // in the order of their issue
  std::vector<Point2> sources;
  std::vector<Point2> starts;  // one per robot
  std::vector<MetricPoint> metrics;
  std::optional<TeamPicture> team = {};            // of several robots
  std::optional<ObjectiveOutcome> objective = {};  // none: a complete map
  std::optional<double> server_killed_s;           // on purpose, at this time of the mission
  std::vector<std::pair<std::string, std::string>> key_numbers;  // name, value with unit
  std::string explorer = {};  // HTML of the mission to look around in, for the page only
};

}  // namespace plumescout::lab
