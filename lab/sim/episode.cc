// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/episode.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/mutex.h"
#include "client/robot_loop.h"
#include "client/robot_observer.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "lab/sim/company.h"
#include "lab/sim/faulty_link.h"

namespace plumescout::lab {
namespace {

constexpr double kIdleTick_s = 0.1;  // of who takes no part

absl::Status Validate(const EpisodeOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Checker()
                                 .Positive("duration_s", options.duration_s)
                                 .Positive("metrics_period_s", options.metrics_period_s)
                                 .Positive("prior_variance_ppm2", options.prior_variance_ppm2)
                                 .status());
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options.traits.outages));
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
  if (options.mission_corrects_lag) {
    client::Participation& participation = loop.participation;
    participation.sensors.emplace_back().id = "gas";
    participation.sensors.back().response_time_s = options.simulated.gas_sensor.time_constant_s;
  } else if (options.correct_gas_lag) {
    loop.gas_sampling.time_constant_s = options.simulated.gas_sensor.time_constant_s;
  }
  loop.gas_sampling.settling_s = options.gas_settling_s;
  loop.blockage.end_margin_m = options.end_margin_m;
  loop.plan_latency_s = options.plan_latency_s;
  loop.replan_period_s = options.replan_period_s;
  loop.real_clock = options.realtime;
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
  const RobotTraits& traits = options.traits;
  if (traits.top_speed_mps) {
    simulated.max_forward_mps = *traits.top_speed_mps;
    simulated.pace.top_speed_mps = *traits.top_speed_mps;
  }
  simulated.clock = traits.clock;
  if (traits.jump) simulated.pose_error.jump = traits.jump;
  return SimulatedRobot::Create(world, simulated);
}

// What robots of one episode share beside the world.
struct Stage {
  client::PlannerClient& planner;
  MapJudge& judge;
  const Company& company;
  absl::Mutex& telling;  // held while a listener is called
  const StopFn& stop;
};

// Writes down what one robot does, and has the map judged now and then.
class EpisodeRecorder : public client::RobotObserver {
 public:
  EpisodeRecorder(const Stage& stage, const SimulatedRobot& robot, const EpisodeOptions& options,
                  int index)
      : stage_(stage), robot_(robot), options_(options), index_(index) {
    result_.robot = options.robot;
  }

  void OnTick(const client::RobotTick& tick) override {
    now_s_ = robot_.elapsed_s();  // the robot's own clock may be wrong
    result_.path.push_back({now_s_, tick.pose});
    // In lockstep the world waits, so that the map does not depend on who is faster.
    const std::int64_t least = options_.realtime ? 0 : tick.ingest.applied_sequence;
    stage_.judge.TakeIfDue(now_s_, {{options_.robot, least}});
    const absl::MutexLock lock(&stage_.telling);
    if (options_.on_time) options_.on_time(now_s_);
  }

  void OnPlan(const client::PlanArrival& arrival) override {
    result_.plans.push_back({robot_.ElapsedAt_s(arrival.time_ns), arrival.rpc_wall, arrival.plan});
    const absl::MutexLock lock(&stage_.telling);
    if (options_.on_plan) options_.on_plan(result_.plans.back());
  }

  void OnReport(PlanId plan, ProgressOutcome outcome) override {
    result_.legs_ended.push_back(
        {now_s_, options_.robot, plan, outcome, stage_.company.Nearest_m(index_)});
    const absl::MutexLock lock(&stage_.telling);
    if (options_.on_leg) options_.on_leg(result_.legs_ended.back());
  }

  EpisodeResult& result() { return result_; }

 private:
  const Stage& stage_;
  const SimulatedRobot& robot_;
  const EpisodeOptions& options_;
  const int index_;
  double now_s_ = 0.0;
  EpisodeResult result_;
};

// One robot's part in an episode: it joins, and joins again after each absence.
class RobotLife {
 public:
  RobotLife(SimulatedRobot& robot, const EpisodeOptions& options, const Stage& stage, int index)
      : robot_(robot),
        options_(options),
        stage_(stage),
        link_(stage.planner),
        recorder_(stage, robot, options, index) {
    robot_.set_listener([this] { NoteTime(); });
    NoteTime();
  }
  ~RobotLife() { robot_.set_listener(nullptr); }
  RobotLife(const RobotLife&) = delete;
  RobotLife& operator=(const RobotLife&) = delete;

  absl::StatusOr<EpisodeResult> Run() {
    while (true) {
      PLUMESCOUT_ASSIGN_OR_RETURN(const bool can_join, AwaitLink());
      if (!can_join) return std::move(recorder_.result());
      const double begun_s = robot_.elapsed_s();
      const Outage* absence = NextAbsence(options_.traits.outages, begun_s);
      PLUMESCOUT_RETURN_IF_ERROR(TakePart(begun_s, absence));
      const bool goes_away = absence != nullptr && !recorder_.result().completed &&
                             HasCome(absence->at_s, robot_.elapsed_s());
      if (!goes_away) return std::move(recorder_.result());
      PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_back, BeAbsent(*absence));
      if (!is_back) return std::move(recorder_.result());
    }
  }

 private:
  // Whatever happens to link and clocks happens here, when it is the robot's turn.
  void NoteTime() {
    link_.Set(LinkAt(options_.traits.outages, robot_.elapsed_s()));
    own_time_ns_ = robot_.now_ns();
    if (options_.world_time_ns) *options_.world_time_ns = robot_.world_time_ns();
  }

  // A map that cannot be had ends the episode: its samples are what it is for.
  bool IsStopped() const { return stage_.stop() || !stage_.judge.status().ok(); }

  client::RobotLoopOptions OptionsFrom(double begun_s, const Outage* absence) {
    client::RobotLoopOptions loop = LoopOptions(options_);
    loop.link_is_down = [this] { return link_.state() != LinkState::kUp; };
    loop.participation.take_over = begun_s > 0.0;  // from its own former life
    if (options_.world_time_ns) loop.ingest.robot_clock_ns = [this] { return own_time_ns_.load(); };
    // Nobody hears what a robot that was switched off has left to say.
    const bool falls_silent = absence != nullptr && absence->kind == OutageKind::kSilent;
    if (falls_silent) loop.drain_timeout = absl::Seconds(1);
    return loop;
  }

  absl::Status TakePart(double begun_s, const Outage* absence) {
    client::RobotLoop loop(link_, robot_, OptionsFrom(begun_s, absence), recorder_);
    PLUMESCOUT_ASSIGN_OR_RETURN(const client::RobotResult ran, loop.Run([&] {
      return IsStopped() || HasCome(options_.duration_s, robot_.elapsed_s()) ||
             (absence != nullptr && HasCome(absence->at_s, robot_.elapsed_s()));
    }));
    EpisodeResult& result = recorder_.result();
    result.readings_sent = std::max(result.readings_sent, ran.ingest.last_sequence);
    result.readings_applied = std::max(result.readings_applied, ran.ingest.applied_sequence);
    result.simulated_s = robot_.elapsed_s();
    result.distance_m += ran.distance_m;
    result.collisions = robot_.collisions();
    result.legs += ran.reached + ran.blocked + ran.aborted;
    result.blocked_legs += ran.blocked;
    result.invalidated_legs += ran.invalidated;
    result.completed = ran.end == client::RobotEnd::kMissionComplete;
    return absl::OkStatus();
  }

  // Who comes back while it has no link cannot join yet, and the world does not wait for it.
  // Whether there is a link before the time is up.
  absl::StatusOr<bool> AwaitLink() {
    while (!IsStopped() && link_.state() != LinkState::kUp &&
           !HasCome(options_.duration_s, robot_.elapsed_s())) {
      PLUMESCOUT_RETURN_IF_ERROR(BeIdle(kIdleTick_s));
    }
    recorder_.result().absent = link_.state() != LinkState::kUp;
    return !recorder_.result().absent;
  }

  absl::Status BeIdle(double duration_s) {
    PLUMESCOUT_RETURN_IF_ERROR(robot_.Advance(duration_s));
    stage_.judge.TakeIfDue(robot_.elapsed_s(), {});
    return absl::OkStatus();
  }

  // Whether the robot comes back.
  absl::StatusOr<bool> BeAbsent(const Outage& absence) {
    recorder_.result().absent = true;
    if (absence.kind == OutageKind::kLeaves) {
      PLUMESCOUT_RETURN_IF_ERROR(
          stage_.planner.RemoveRobot(options_.mission, options_.robot, 0, /*force=*/true));
    }
    if (HasCome(options_.duration_s, absence.end_s())) return false;
    while (!IsStopped() && !HasCome(absence.end_s(), robot_.elapsed_s())) {
      PLUMESCOUT_RETURN_IF_ERROR(
          BeIdle(std::min(kIdleTick_s, absence.end_s() - robot_.elapsed_s())));
    }
    recorder_.result().absent = IsStopped();
    return !IsStopped();
  }

  SimulatedRobot& robot_;
  const EpisodeOptions& options_;
  const Stage& stage_;
  FaultyLink link_;
  std::atomic<std::int64_t> own_time_ns_ = 0;
  EpisodeRecorder recorder_;
};

// The options of every robot, the first one's first.
std::vector<EpisodeOptions> OptionsOfAll(const EpisodeOptions& options,
                                         const std::vector<Teammate>& teammates) {
  std::vector<EpisodeOptions> all = {options};
  for (const Teammate& teammate : teammates) {
    EpisodeOptions one = options;
    one.robot = teammate.robot;
    one.simulated.start = teammate.start;
    one.simulated.seed = teammate.seed;
    one.traits = teammate.traits;
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
  const Stage guarded{stage.planner, stage.judge, stage.company, stage.telling, stop};
  std::vector<absl::StatusOr<EpisodeResult>> results(robots.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    threads.emplace_back([&, i] {
      const int index = static_cast<int>(i);
      company.AwaitTurn(index, robots[i].world_time_ns());
      results[i] = RobotLife(robots[i], options[i], guarded, index).Run();
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

bool IsComplete(const TeamResult& team) {
  const auto is_done = [](const EpisodeResult& robot) { return robot.completed || robot.absent; };
  const auto is_absent = [](const EpisodeResult& robot) { return robot.absent; };
  return std::all_of(team.robots.begin(), team.robots.end(), is_done) &&
         !std::all_of(team.robots.begin(), team.robots.end(), is_absent);
}

absl::StatusOr<TeamResult> RunTeamEpisode(client::PlannerClient& planner, const SceneWorld& world,
                                          const EpisodeOptions& options,
                                          const std::vector<Teammate>& teammates,
                                          const StopFn& stop) {
  const std::vector<EpisodeOptions> all = OptionsOfAll(options, teammates);
  for (const EpisodeOptions& one : all) PLUMESCOUT_RETURN_IF_ERROR(Validate(one));
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
  auto results = RunTogether(robots, all, company, {planner, judge, company, telling, stop});

  TeamResult team;
  AppliedSequences applied;
  double end_s = 0.0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(results[i].status());
    // Of who is not there any more nothing is waited for.
    if (!results[i]->absent) applied[all[i].robot] = results[i]->readings_applied;
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
