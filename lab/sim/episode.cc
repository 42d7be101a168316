// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/episode.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/robot_loop.h"
#include "client/robot_observer.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

// How long a map is waited for that holds what the planner has acknowledged, and between looks.
constexpr absl::Duration kMapPatience = absl::Seconds(10);
constexpr absl::Duration kMapPause = absl::Milliseconds(2);

absl::Status CheckPositive(const char* field, double value) {
  if (value > 0.0 && std::isfinite(value)) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(field, " = ", value, " must be > 0 and finite"));
}

absl::Status Validate(const EpisodeOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckPositive("duration_s", options.duration_s));
  PLUMESCOUT_RETURN_IF_ERROR(CheckPositive("metrics_period_s", options.metrics_period_s));
  return CheckPositive("prior_variance_ppm2", options.prior_variance_ppm2);
}

client::RobotLoopOptions LoopOptions(const EpisodeOptions& options) {
  client::RobotLoopOptions loop;
  loop.participation = {
      .mission = options.mission, .robot = options.robot, .create = options.create};
  loop.pacing = options.realtime ? client::Pacing::kFreeRunning : client::Pacing::kLockstep;
  loop.following = options.following;
  loop.rates = options.rates;
  if (options.correct_gas_lag) {
    loop.gas_time_constant_s = options.simulated.gas_sensor.time_constant_s;
  }
  loop.time_limit_s = options.duration_s;
  loop.max_edge_evaluations = options.max_edge_evaluations;
  loop.plan_budget = options.plan_budget;
  return loop;
}

std::int64_t AppliedSequence(const MapSnapshot& map, const RobotId& robot) {
  const auto state = std::find_if(map.robots.begin(), map.robots.end(),
                                  [&](const RobotState& r) { return r.id == robot; });
  return state == map.robots.end() ? 0 : state->applied_sequence;
}

// Writes down what happens, and judges the map now and then.
class EpisodeRecorder : public client::RobotObserver {
 public:
  EpisodeRecorder(client::PlannerClient& planner, const SceneWorld& world,
                  const EpisodeOptions& options)
      : planner_(planner),
        options_(options),
        evaluator_(world.scene(), options.prior_variance_ppm2) {}

  void OnTick(const client::RobotTick& tick) override {
    result_.path.push_back({tick.elapsed_s, tick.pose});
    const double due_s = static_cast<double>(result_.samples.size()) * options_.metrics_period_s;
    if (tick.elapsed_s < due_s || !status_.ok()) return;
    // In lockstep the world waits, so that the map does not depend on who is faster.
    status_ = TakeSample(tick.elapsed_s, options_.realtime ? 0 : tick.ingest.last_sequence);
  }

  void OnPlan(const client::PlanArrival& arrival) override {
    result_.plans.push_back({arrival.elapsed_s, arrival.rpc_wall, arrival.plan});
    if (options_.on_plan) options_.on_plan(result_.plans.back());
  }

  // Of the first map that holds the robot's observations up to `sequence`. A server that is away or
  // has lost the mission may be back in a moment, and be told everything again by the robot.
  absl::Status TakeSample(double time_s, std::int64_t sequence) {
    const absl::Time give_up = absl::Now() + kMapPatience;
    while (true) {
      const absl::StatusOr<MapSnapshot> map = planner_.GetMap(options_.mission);
      if (map.ok() && AppliedSequence(*map, options_.robot) >= sequence) {
        result_.samples.push_back({time_s, map->revision, evaluator_.Evaluate(*map)});
        if (options_.on_sample) options_.on_sample(result_.samples.back(), *map);
        return absl::OkStatus();
      }
      const absl::Status why =
          map.ok() ? absl::UnavailableError("the map lags behind") : map.status();
      const bool may_come = absl::IsUnavailable(why) || absl::IsNotFound(why);
      if (!may_come || absl::Now() > give_up) return why;
      absl::SleepFor(kMapPause);
    }
  }

  const absl::Status& status() const { return status_; }  // of the samples
  EpisodeResult& result() { return result_; }

 private:
  client::PlannerClient& planner_;
  const EpisodeOptions& options_;
  MapEvaluator evaluator_;
  EpisodeResult result_;
  absl::Status status_;
};

}  // namespace

absl::StatusOr<EpisodeResult> RunEpisode(client::PlannerClient& planner, const SceneWorld& world,
                                         const EpisodeOptions& options, const StopFn& stop) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  SimulatedRobotOptions simulated = options.simulated;
  simulated.realtime = options.realtime;
  PLUMESCOUT_ASSIGN_OR_RETURN(SimulatedRobot robot, SimulatedRobot::Create(world, simulated));
  EpisodeRecorder recorder(planner, world, options);
  client::RobotLoop loop(planner, robot, LoopOptions(options), recorder);
  // A map that cannot be had ends the episode: its samples are what it is for.
  const auto stop_or_failed = [&] { return stop() || !recorder.status().ok(); };
  PLUMESCOUT_ASSIGN_OR_RETURN(const client::RobotResult ran, loop.Run(stop_or_failed));
  PLUMESCOUT_RETURN_IF_ERROR(recorder.status());
  PLUMESCOUT_RETURN_IF_ERROR(recorder.TakeSample(ran.elapsed_s, ran.ingest.applied_sequence));
  EpisodeResult& result = recorder.result();
  result.readings_sent = ran.ingest.last_sequence;
  result.readings_applied = ran.ingest.applied_sequence;
  result.simulated_s = ran.elapsed_s;
  result.distance_m = ran.distance_m;
  result.collisions = robot.collisions();
  result.completed = ran.end == client::RobotEnd::kMissionComplete;
  return std::move(result);
}

}  // namespace plumescout::lab
