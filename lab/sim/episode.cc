// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/episode.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "client/robot_loop.h"
#include "client/robot_observer.h"
#include "core/types/status_macros.h"
#include "lab/sim/company.h"

namespace plumescout::lab {
namespace {

absl::Status CheckPositive(const char* field, double value) {
  if (value > 0.0 && std::isfinite(value)) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(field, " = ", value, " must be > 0 and finite"));
}

absl::Status Validate(const EpisodeOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckPositive("duration_s", options.duration_s));
  PLUMESCOUT_RETURN_IF_ERROR(CheckPositive("metrics_period_s", options.metrics_period_s));
  PLUMESCOUT_RETURN_IF_ERROR(CheckPositive("prior_variance_ppm2", options.prior_variance_ppm2));
  const bool settles = options.gas_settling_s == 0.0 || !options.create ||
                       options.gas_settling_s < options.create->planning.dwell_s;
  if (settles) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("gas_settling_s = ", options.gas_settling_s, " must be < planning.dwell_s = ",
                   options.create->planning.dwell_s, ", or no reading ever settles"));
}

client::RobotLoopOptions LoopOptions(const EpisodeOptions& options) {
  client::RobotLoopOptions loop;
  loop.participation = {
      .mission = options.mission, .robot = options.robot, .create = options.create};
  loop.pacing = options.realtime ? client::Pacing::kFreeRunning : client::Pacing::kLockstep;
  loop.following = options.following;
  loop.rates = options.rates;
  if (options.correct_gas_lag) {
    loop.gas_sampling.time_constant_s = options.simulated.gas_sensor.time_constant_s;
  }
  loop.gas_sampling.settling_s = options.gas_settling_s;
  loop.time_limit_s = options.duration_s;
  loop.max_edge_evaluations = options.max_edge_evaluations;
  loop.plan_budget = options.plan_budget;
  loop.watch = options.watch;
  return loop;
}

// Checked and made before anything runs.
absl::StatusOr<SimulatedRobot> MakeRobot(const SceneWorld& world, const EpisodeOptions& options,
                                         const Companion& companion) {
  SimulatedRobotOptions simulated = options.simulated;
  simulated.realtime = options.realtime;
  simulated.companion = companion;
  return SimulatedRobot::Create(world, simulated);
}

// What robots of one episode share beside the world.
struct Stage {
  client::PlannerClient& planner;
  MapJudge& judge;
  absl::Mutex& telling;  // held while on_plan is called
  const StopFn& stop;
};

// Writes down what one robot does, and has the map judged now and then.
class EpisodeRecorder : public client::RobotObserver {
 public:
  EpisodeRecorder(const Stage& stage, const EpisodeOptions& options)
      : stage_(stage), options_(options) {}

  void OnTick(const client::RobotTick& tick) override {
    result_.path.push_back({tick.elapsed_s, tick.pose});
    // In lockstep the world waits, so that the map does not depend on who is faster.
    const std::int64_t least = options_.realtime ? 0 : tick.ingest.last_sequence;
    stage_.judge.TakeIfDue(tick.elapsed_s, {{options_.robot, least}});
  }

  void OnPlan(const client::PlanArrival& arrival) override {
    result_.plans.push_back({arrival.elapsed_s, arrival.rpc_wall, arrival.plan});
    const absl::MutexLock lock(&stage_.telling);
    if (options_.on_plan) options_.on_plan(result_.plans.back());
  }

  EpisodeResult& result() { return result_; }

 private:
  const Stage& stage_;
  const EpisodeOptions& options_;
  EpisodeResult result_;
};

absl::StatusOr<EpisodeResult> RunRobot(SimulatedRobot& robot, const EpisodeOptions& options,
                                       const Stage& stage) {
  EpisodeRecorder recorder(stage, options);
  client::RobotLoop loop(stage.planner, robot, LoopOptions(options), recorder);
  // A map that cannot be had ends the episode: its samples are what it is for.
  const auto stop_or_failed = [&] { return stage.stop() || !stage.judge.status().ok(); };
  PLUMESCOUT_ASSIGN_OR_RETURN(const client::RobotResult ran, loop.Run(stop_or_failed));
  EpisodeResult& result = recorder.result();
  result.readings_sent = ran.ingest.last_sequence;
  result.readings_applied = ran.ingest.applied_sequence;
  result.simulated_s = ran.elapsed_s;
  result.distance_m = ran.distance_m;
  result.collisions = robot.collisions();
  result.legs = ran.reached + ran.blocked + ran.aborted;
  result.blocked_legs = ran.blocked;
  result.invalidated_legs = ran.invalidated;
  result.completed = ran.end == client::RobotEnd::kMissionComplete;
  return std::move(result);
}

// The options of every robot, the first one's first.
std::vector<EpisodeOptions> OptionsOfAll(const EpisodeOptions& options,
                                         const std::vector<Teammate>& teammates) {
  std::vector<EpisodeOptions> all = {options};
  for (const Teammate& teammate : teammates) {
    EpisodeOptions one = options;
    one.robot = teammate.robot;
    one.simulated.start = teammate.start;
    one.simulated.seed = teammate.seed;
    all.push_back(std::move(one));
  }
  all.front().watch = options.watch && all.size() > 1;
  return all;
}

absl::Status CheckNames(const std::vector<EpisodeOptions>& robots) {
  std::set<RobotId> names;
  for (const EpisodeOptions& robot : robots) {
    PLUMESCOUT_RETURN_IF_ERROR(ValidateId("robot", robot.robot));
    if (!names.insert(robot.robot).second) {
      return absl::InvalidArgumentError(
          absl::StrCat("robot = \"", robot.robot, "\" is the name of two robots"));
    }
  }
  return absl::OkStatus();
}

// Runs every robot on a thread of its own. An error ends it for all.
std::vector<absl::StatusOr<EpisodeResult>> RunTogether(std::vector<SimulatedRobot>& robots,
                                                       const std::vector<EpisodeOptions>& options,
                                                       Company& company, const Stage& stage) {
  std::atomic<bool> failed = false;
  const StopFn stop = [&] { return failed || stage.stop(); };
  const Stage guarded{stage.planner, stage.judge, stage.telling, stop};
  std::vector<absl::StatusOr<EpisodeResult>> results(robots.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    threads.emplace_back([&, i] {
      const int index = static_cast<int>(i);
      company.AwaitTurn(index, robots[i].now_ns());
      results[i] = RunRobot(robots[i], options[i], guarded);
      if (!results[i].ok()) failed = true;
      company.Leave(index);
    });
  }
  for (std::thread& thread : threads) thread.join();
  return results;
}

MapJudge MakeJudge(client::PlannerClient& planner, const SceneWorld& world,
                   const EpisodeOptions& options) {
  return MapJudge(planner, options.mission, options.metrics_period_s,
                  MapEvaluator(world.scene(), options.prior_variance_ppm2, world.ambient_ppm()),
                  options.on_sample);
}

}  // namespace

absl::StatusOr<EpisodeResult> RunEpisode(client::PlannerClient& planner, const SceneWorld& world,
                                         const EpisodeOptions& options, const StopFn& stop) {
  PLUMESCOUT_ASSIGN_OR_RETURN(TeamResult team, RunTeamEpisode(planner, world, options, {}, stop));
  EpisodeResult result = std::move(team.robots.front());
  result.samples = std::move(team.samples);
  return result;
}

absl::StatusOr<TeamResult> RunTeamEpisode(client::PlannerClient& planner, const SceneWorld& world,
                                          const EpisodeOptions& options,
                                          const std::vector<Teammate>& teammates,
                                          const StopFn& stop) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  const std::vector<EpisodeOptions> all = OptionsOfAll(options, teammates);
  PLUMESCOUT_RETURN_IF_ERROR(CheckNames(all));
  Company company(static_cast<int>(all.size()), !options.realtime);
  std::vector<SimulatedRobot> robots;
  for (std::size_t i = 0; i < all.size(); ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(SimulatedRobot robot,
                                MakeRobot(world, all[i], {&company, static_cast<int>(i)}));
    robots.push_back(std::move(robot));
  }
  MapJudge judge = MakeJudge(planner, world, options);
  absl::Mutex telling;
  auto results = RunTogether(robots, all, company, {planner, judge, telling, stop});

  TeamResult team;
  AppliedSequences applied;
  double end_s = 0.0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(results[i].status());
    applied[all[i].robot] = results[i]->readings_applied;
    end_s = std::max(end_s, results[i]->simulated_s);
    team.robots.push_back(*std::move(results[i]));
  }
  PLUMESCOUT_RETURN_IF_ERROR(judge.status());
  PLUMESCOUT_RETURN_IF_ERROR(judge.Take(end_s, applied));
  team.samples = judge.samples();
  team.closest_m = company.closest_m();
  team.contacts = company.contacts();
  return team;
}

}  // namespace plumescout::lab
