// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/trial.h"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <variant>

#include "absl/time/time.h"
#include "core/types/event.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/local/local_planner_client.h"
#include "lab/sim/episode.h"
#include "lab/sim/team_starts.h"
#include "lab/trials/gas_recording.h"
#include "lab/trials/recorded_map.h"
#include "lab/trials/study.h"
#include "lab/trials/team_watch.h"
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

// What else than the mission's own map a trial makes of what was heard.
struct Heard {
  std::vector<Observation> readings;
  GasRecording recording;
};

void Note(const Trial& trial, const Event& event, TrialRecord& record, Heard& heard) {
  if (trial.second_field) {
    if (const auto pose = HeardIn(event)) heard.recording.heard.push_back(*pose);
  }
  const Observation* gas = GasObservation(event);
  if (gas == nullptr) return;
  ++record.gas_readings;
  if (trial.peer || trial.tells_other_entropies) heard.readings.push_back(*gas);
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

double DistanceNow_m(const std::vector<DrivenPose>& a, std::size_t i,
                     const std::vector<DrivenPose>& b, std::size_t& j) {
  while (j + 1 < b.size() && b[j + 1].time_s <= a[i].time_s) ++j;
  return Distance_m(a[i].pose.position(), b[j].pose.position());
}

// Each time that two come near, once for both.
int Encounters(const std::vector<DrivenPose>& a, const std::vector<DrivenPose>& b, double near_m) {
  int encounters = 0;
  bool are_near = false;
  std::size_t j = 0;
  for (std::size_t i = 0; i < a.size() && !b.empty(); ++i) {
    const bool near_now = DistanceNow_m(a, i, b, j) < near_m;
    if (near_now && !are_near) ++encounters;
    are_near = near_now;
  }
  return encounters;
}

TeamRecord MakeTeamRecord(const TeamResult& team, double radius_m) {
  TeamRecord record;
  std::vector<double> walls_s;
  const std::vector<EpisodeResult>& robots = team.robots;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    record.legs += robots[i].legs;
    record.blocked_legs += robots[i].blocked_legs;
    record.robot_s += robots[i].simulated_s;
    for (const IssuedPlan& issued : robots[i].plans) {
      walls_s.push_back(absl::ToDoubleSeconds(issued.rpc_wall));
      const std::vector<Waypoint>& waypoints = issued.plan.trajectory.waypoints;
      // At the end of their ways robots stand aside, which is no wait.
      for (std::size_t k = 0; k + 1 < waypoints.size(); ++k) {
        record.waiting_s += waypoints[k].dwell_s;
      }
    }
    for (std::size_t j = i + 1; j < robots.size(); ++j) {
      record.encounters +=
          Encounters(robots[i].path, robots[j].path, 2.0 * radius_m + kEncounterMargin_m);
    }
  }
  record.contacts = team.contacts;
  if (std::isfinite(team.closest_m)) record.closest_m = team.closest_m;
  constexpr double kMedian = 0.5;
  record.plan_wall_s = walls_s.empty() ? 0.0 : Quantile(walls_s, kMedian);
  return record;
}

absl::StatusOr<std::vector<Teammate>> MakeTeammates(const Trial& trial,
                                                    const EpisodeOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const std::vector<Pose2> starts,
      TeamStarts(*trial.world, trial.robots, options.simulated.body_radius_m));
  const std::vector<RobotId> names = TeamNames(options.robot, trial.robots);
  std::vector<Teammate> teammates;
  for (std::size_t i = 1; i < starts.size(); ++i) {
    constexpr std::uint64_t kApart = 1000;  // seeds of teammates from those of other trials
    teammates.push_back({names[i], starts[i], trial.seed + kApart * i});
  }
  return teammates;
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
  options.simulated.pace.most_late_s = trial.most_late_s;
  options.simulated.has_body = !trial.ghosts;
  options.simulated.lidar.max_range_m = trial.robot.lidar_range_m;
  options.end_margin_m = kStudiedEndMargin_m;
  options.plan_latency_s = trial.robot.plan_latency_s;
  options.replan_period_s = trial.robot.replan_period_s;
  options.correct_gas_lag = trial.robot.corrects_gas_lag;
  options.mission_corrects_lag = trial.robot.leaves_lag_to_mission;
  options.prior_variance_ppm2 = OpenLatticeVariance_ppm2(trial.mission->gas);
  options.on_sample = [&trial, &record](const MetricSample& sample, const MapSnapshot& map) {
    record.curve.push_back({sample.time_s, sample.metrics});
    const std::size_t kept = record.mean_ppm.size();
    if (kept == trial.map_times_s.size() || sample.time_s < trial.map_times_s[kept]) return;
    record.mean_ppm.push_back(OnSceneGrid(map.gas_mean_ppm, trial.world->scene().geometry()));
  };
  return options;
}

// Has the watch look on, once a second and whenever there is something to tell.
void LetWatch(TeamWatch& watch, const LocalPlannerClient& planner, EpisodeOptions& options) {
  const auto tell = [&planner](const auto& told) {
    const auto belief = planner.GetBelief(kMission);
    if (belief.ok()) told(**belief);
  };
  const auto next_s = std::make_shared<double>(0.0);  // of all robots
  options.on_time = [&watch, tell, next_s](double time_s) {
    constexpr double kPeriod_s = 1.0;
    if (time_s < *next_s) return;
    *next_s = time_s + kPeriod_s;
    tell([&watch](const Belief& belief) { watch.OnTime(belief); });
  };
  options.on_plan = [&watch, tell](const IssuedPlan& issued) {
    tell([&](const Belief& belief) { watch.OnPlan(belief, issued.plan); });
  };
  const double radius_m = options.simulated.seen_radius_m;
  options.on_leg = [&watch, radius_m](const EndedLeg& leg) { watch.OnLeg(leg, radius_m); };
}

// Once a plan goes to no frontier, for none is left.
void EndWithoutFrontier(std::atomic<bool>& over, EpisodeOptions& options) {
  options.on_plan = [&over, told = std::move(options.on_plan)](const IssuedPlan& issued) {
    if (told) told(issued);
    if (issued.plan.phase == MissionPhase::kFallback) over = true;
  };
}

// By all but the mission's own map.
absl::Status JudgeOtherwise(const Trial& trial, const EpisodeOptions& options,
                            const MapSnapshot& map, Heard& heard, TrialRecord& record) {
  const Scene& scene = trial.world->scene();
  if (trial.tells_other_entropies) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        record.other_entropies,
        FindOtherEntropies(scene, trial.mission->gas, heard.readings, map.occupancy));
  }
  if (trial.peer) {
    PLUMESCOUT_ASSIGN_OR_RETURN(record.peer_rmse_ppm,
                                PeerError_ppm(scene, *trial.peer, heard.readings));
  }
  if (trial.second_field) {
    GasRecording& recording = heard.recording;
    recording.states = map.occupancy;
    if (options.mission_corrects_lag) {
      recording.response_time_s = options.simulated.gas_sensor.time_constant_s;
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(const MapSnapshot second,
                                MapRecording(recording, AtPoints(recording), *trial.second_field));
    const MapEvaluator evaluator(scene, OpenLatticeVariance_ppm2(*trial.second_field));
    record.second_field = evaluator.Evaluate(second);
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<TrialRecord> RunTrial(const Trial& trial) {
  TrialRecord record;
  LocalOptions local;
  local.path_planners = MakeOmplPlanner;
  if (trial.rule) {
    local.replace_strategy = [&trial](const PlanningOptions& planning,
                                      std::unique_ptr<const Strategy> frontiers) {
      return MakeTeamRival(*trial.rule, planning, std::move(frontiers));
    };
  }
  Heard heard;
  local.on_event = [&](const Event& event) { Note(trial, event, record, heard); };
  LocalPlannerClient planner(local);
  EpisodeOptions options = MakeEpisodeOptions(trial, record);
  TeamWatch watch(trial.robot.lidar_range_m);
  if (trial.robots > 1) LetWatch(watch, planner, options);
  std::atomic<bool> over = false;
  if (trial.robot.stops_without_frontier) EndWithoutFrontier(over, options);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Teammate> teammates, MakeTeammates(trial, options));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const TeamResult team,
      RunTeamEpisode(planner, *trial.world, options, teammates, [&over] { return over.load(); }));
  record.completed = true;
  for (const EpisodeResult& robot : team.robots) {
    record.distance_m += robot.distance_m;
    record.plans += static_cast<int>(robot.plans.size());
    record.collisions += robot.collisions;
    record.completed = record.completed && robot.completed;
  }
  record.team = MakeTeamRecord(team, options.simulated.seen_radius_m);
  record.team.findings = watch.findings();
  PLUMESCOUT_ASSIGN_OR_RETURN(const MapSnapshot map, planner.GetMap(kMission));
  while (record.mean_ppm.size() < trial.map_times_s.size()) {
    record.mean_ppm.push_back(OnSceneGrid(map.gas_mean_ppm, trial.world->scene().geometry()));
  }
  record.calibration = Calibrate(trial.world->scene(), map.gas_mean_ppm, map.gas_variance_ppm2,
                                 trial.world->ambient_ppm());
  if (trial.on_end) trial.on_end(team, map);
  PLUMESCOUT_RETURN_IF_ERROR(JudgeOtherwise(trial, options, map, heard, record));
  return record;
}

}  // namespace plumescout::lab
