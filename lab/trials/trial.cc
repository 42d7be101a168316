// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/trial.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <variant>

#include "absl/time/time.h"
#include "core/types/event.h"
#include "core/types/status_macros.h"
#include "lab/local/local_planner_client.h"
#include "lab/sim/episode.h"
#include "ompl_planners/ompl_planner.h"

namespace plumescout::lab {
namespace {

constexpr char kMission[] = "trial";
// Longer than any trial: the posterior is refreshed when somebody asks for it.
constexpr double kNoRefresh_s = 3600.0;

Grid<float> OnSceneGrid(const Grid<float>& field, const GridGeometry& geometry) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  Grid<float> moved(geometry, kNone);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Point2 center = geometry.Center(geometry.CellAtIndex(i));
    moved[i] = field.At(field.geometry().CellAt(center), kNone);
  }
  return moved;
}

// The gas reading that the event brings, or null.
const Observation* GasObservation(const Event& event) {
  const auto* received = std::get_if<ObservationReceived>(&event.body);
  const bool is_gas =
      received != nullptr && std::holds_alternative<GasReading>(received->observation.payload);
  return is_gas ? &received->observation : nullptr;
}

// RMSE of the readings' map in critical cells, as of [XIT] Eq. (23).
absl::StatusOr<double> PeerError_ppm(const Scene& scene, const KernelDmvOptions& options,
                                     const std::vector<Observation>& readings) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  KernelDmv mapper(options);
  for (const Observation& reading : readings) {
    PLUMESCOUT_RETURN_IF_ERROR(
        mapper.Add(reading.pose.position(), std::get<GasReading>(reading.payload)));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const MappedGas map, mapper.MapOver(scene.occupancy));
  double squares = 0.0;
  double cells = 0.0;
  for (std::size_t i = 0; i < map.mean_ppm.size(); ++i) {
    if (!(scene.conc_mean_ppm[i] > scene.critical_threshold_ppm)) continue;
    const double error = static_cast<double>(map.mean_ppm[i]) - scene.conc_mean_ppm[i];
    squares += error * error;
    cells += 1.0;
  }
  return cells > 0.0 ? std::sqrt(squares / cells) : 0.0;
}

EpisodeOptions MakeEpisodeOptions(const Trial& trial, TrialRecord& record) {
  EpisodeOptions options;
  options.mission = kMission;
  options.create = *trial.mission;
  options.create->seed = trial.seed;
  options.create->gas.refresh_period_s = kNoRefresh_s;
  options.duration_s = trial.duration_s;
  options.plan_budget = absl::InfiniteDuration();
  options.simulated.seed = trial.seed;
  options.prior_variance_ppm2 = OpenLatticeVariance_ppm2(trial.mission->gas);
  options.on_sample = [&trial, &record](const MetricSample& sample, const MapSnapshot& map) {
    record.curve.push_back({sample.time_s, sample.metrics});
    const std::size_t kept = record.mean_ppm.size();
    if (kept == trial.map_times_s.size() || sample.time_s < trial.map_times_s[kept]) return;
    record.mean_ppm.push_back(OnSceneGrid(map.gas_mean_ppm, trial.world->scene().geometry()));
  };
  return options;
}

}  // namespace

absl::StatusOr<TrialRecord> RunTrial(const Trial& trial) {
  TrialRecord record;
  LocalOptions local;
  local.path_planners = MakeOmplPlanner;
  std::vector<Observation> readings;
  local.on_event = [&](const Event& event) {
    const Observation* gas = GasObservation(event);
    if (gas == nullptr) return;
    ++record.gas_readings;
    if (trial.peer) readings.push_back(*gas);
  };
  LocalPlannerClient planner(local);
  PLUMESCOUT_ASSIGN_OR_RETURN(const EpisodeResult episode,
                              RunEpisode(planner, *trial.world, MakeEpisodeOptions(trial, record)));
  record.distance_m = episode.distance_m;
  record.plans = static_cast<int>(episode.plans.size());
  record.collisions = episode.collisions;
  record.completed = episode.completed;
  if (trial.peer) {
    PLUMESCOUT_ASSIGN_OR_RETURN(record.peer_rmse_ppm,
                                PeerError_ppm(trial.world->scene(), *trial.peer, readings));
  }
  return record;
}

}  // namespace plumescout::lab
