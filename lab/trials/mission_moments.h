// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/plan/cost/information_map.h"
#include "core/types/plan.h"
#include "lab/report/chart.h"
#include "lab/report/map_panel.h"
#include "lab/sim/episode.h"
#include "lab/sim/scene_world.h"

namespace plumescout::lab {

// A trajectory that was chosen, and what was believed then.
struct MissionMoment {
  double time_s = 0.0;
  Plan plan;  // with a choice
  std::shared_ptr<const Belief> belief;
};

// A gas reading as the planner got it.
struct MissionReading {
  double time_s = 0.0;
  Point2 position;
  double concentration_ppm = 0.0;
};

struct RecordedMission {
  EpisodeResult episode;
  std::vector<MissionMoment> moments;  // one per trajectory
  std::vector<MissionReading> readings;
  MapSnapshot map;  // at the end
};

// Drives one robot through the world, planned in this process, and keeps what pictures need. Plans
// take as long as they take, so the same options give the same mission. Told the finished share of
// the longest possible time now and then. Errors: as RunEpisode.
absl::StatusOr<RecordedMission> RecordMission(const SceneWorld& world, EpisodeOptions options,
                                              const std::function<void(double)>& progress);

// The candidate that was chosen.
const Candidate& Chosen(const MissionMoment& moment);
// Where the robot was up to the moment.
std::vector<Point2> DrivenUntil(const RecordedMission& mission, double time_s);
// The information map on which the moment's plan was made.
InformationMap InformationOf(const MissionMoment& moment);

// How pictures of moments are made.
struct MomentStyle {
  Region region;
  double clean_air_ppm = 0.0;  // gets the first colour
};

// The posterior mean, from clean air to its greatest value at the moment; frontiers of both kinds,
// the way so far and the trajectory that was chosen.
MapPanel MomentPanel(const RecordedMission& mission, const MissionMoment& moment,
                     const std::string& title, const MomentStyle& style);
// The information map with the paths to all candidates, that of the choice thick; cells too near to
// obstacles grey.
MapPanel MomentFieldPanel(const MissionMoment& moment, const std::string& title,
                          const MomentStyle& style);

// What is true on average, and the sources. Concentrations span decades: a logarithmic scale, but
// from ambient air, if there is any in the world, an even one.
MapPanel TrueMeanPanel(const SceneWorld& world, const std::string& title);

// Completeness, RMSE and entropy over time.
std::vector<Chart> MetricCharts(const EpisodeResult& episode);
// The same as rows of time_s, completeness, rmse_ppm, rmse_zero_ppm, entropy_nats.
std::vector<std::vector<double>> MetricRows(const EpisodeResult& episode);

}  // namespace plumescout::lab
