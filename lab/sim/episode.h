// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/blockage.h"
#include "client/motion.h"
#include "client/planner_client.h"
#include "client/sensor_bridge.h"
#include "core/types/event.h"
#include "core/types/ids.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/stop.h"
#include "lab/sim/map_judge.h"
#include "lab/sim/outage.h"
#include "lab/sim/scene_world.h"
#include "lab/sim/simulated_robot.h"

namespace plumescout::lab {

struct IssuedPlan {
  double time_s = 0.0;      // when it was asked for
  absl::Duration rpc_wall;  // from asking to answer
  Plan plan;
};

struct DrivenPose {
  double time_s = 0.0;
  Pose2 pose;
};

// A leg that has ended.
struct EndedLeg {
  double time_s = 0.0;
  RobotId robot;
  PlanId plan = 0;
  ProgressOutcome outcome = ProgressOutcome::kReached;
  double nearest_m = 0.0;  // to the nearest other robot then, centre to centre; infinity: alone
};

// What sets one robot apart from others of its team, and what befalls it.
struct RobotTraits {
  std::optional<double> top_speed_mps = std::nullopt;  // plans are timed as if it had none
  ClockErrorOptions clock = {};
  std::optional<PoseJumpOptions> jump = std::nullopt;
  std::vector<Outage> outages = {};
};

// One robot in one scene, or the first of several.
struct EpisodeOptions {
  MissionId mission;
  RobotId robot = "robot-1";
  std::optional<MissionOptions> create;  // create the mission if it is not there
  double duration_s = 300.0;             // of simulated time, [XIT] section VI-B, > 0
  client::Following following = client::Following::kIdeal;
  client::SensorRates rates;
  bool correct_gas_lag = true;  // undo the lag of the gas sensor, which the robot knows
  // Instead the mission undoes it, along the way: see GasSensor::response_time_s.
  bool mission_corrects_lag = false;
  double gas_settling_s = 0.0;  // see client::GasSampling; < the mission's dwell_s
  // See client::BlockageOptions.
  double end_margin_m = client::BlockageOptions{}.end_margin_m;
  // In lockstep: how long the robot stands for each plan, >= 0.
  double plan_latency_s = 0.1;
  std::optional<double> replan_period_s = 0.0;  // see client::RobotLoopOptions
  // False: the world waits for acknowledgements and plans, so an episode is repeatable. True: time
  // goes by as on a wall clock, plans take as long as they take.
  bool realtime = false;
  // Bounds on each plan: its work (see PlanRequest; 0: none) and its time. Episodes that are to be
  // repeatable bound the work and set an infinite time.
  std::int64_t max_edge_evaluations = 0;
  absl::Duration plan_budget = absl::Seconds(1);
  // Robots of a team heed what the service tells unasked. One that is alone knows what that could
  // tell.
  bool watch = true;
  SimulatedRobotOptions simulated;  // `realtime` and what traits say are set from these
  RobotTraits traits;
  // In lockstep, if somebody has to know: what time it is in the world is written here, and batches
  // say by the robot's own clock when they were sent. May be null. (In real time they do always.)
  std::shared_ptr<std::atomic<std::int64_t>> world_time_ns;
  double metrics_period_s = 5.0;  // > 0
  // Where the map has no estimate, see MapEvaluator.
  double prior_variance_ppm2 = OpenLatticeVariance_ppm2(GasOptions{});
  // Told of every sample as it is taken; may be empty.
  std::function<void(const MetricSample&, const MapSnapshot&)> on_sample;
  // Told of every plan as it arrives; may be empty.
  std::function<void(const IssuedPlan&)> on_plan;
  // Told of every leg as it ends, before it is reported; may be empty.
  std::function<void(const EndedLeg&)> on_leg;
  // Told what time it is at every tick of a robot; may be empty.
  std::function<void(double time_s)> on_time;
};

struct EpisodeResult {
  RobotId robot;
  std::vector<MetricSample>
      samples;  // at 0, every period, and at the end with all readings applied
  std::vector<IssuedPlan> plans;
  std::vector<DrivenPose> path;  // one per tick of the robot while it takes part
  std::vector<EndedLeg> legs_ended;
  std::int64_t readings_sent = 0;     // scans and gas readings numbered by the robot
  std::int64_t readings_applied = 0;  // of those, by the server's last word
  double simulated_s = 0.0;
  double distance_m = 0.0;
  int collisions = 0;
  int legs = 0;              // that have ended
  int blocked_legs = 0;      // of those, for something stood in the way
  int invalidated_legs = 0;  // for the service said that the plan does not stand
  bool completed = false;    // the planner said so; else the time was up or `stop` said so
  bool absent = false;       // at the end: it fell silent or left, and was not back
};

// Runs a simulated robot against a planning service until the mission is complete or the time is
// up. Errors: those of SimulatedRobot::Create, RobotLoop and GetMap; kInvalidArgument for options.
absl::StatusOr<EpisodeResult> RunEpisode(client::PlannerClient& planner, const SceneWorld& world,
                                         const EpisodeOptions& options,
                                         const StopFn& stop = NeverStop());

// Another robot of the same mission.
struct Teammate {
  RobotId robot;
  Pose2 start;
  std::uint64_t seed = 1;
  RobotTraits traits = {};
};

struct TeamResult {
  std::vector<EpisodeResult> robots;  // in the order of the options; their samples are empty
  std::vector<MetricSample> samples;  // of the map that they share
  double closest_m = 0.0;             // that two of them ever came, centre to centre
  int contacts = 0;                   // of bodies
};

// Whether every robot that was there to the end was told that the mission is complete, and some
// were there.
bool IsComplete(const TeamResult& team);

// Several robots that share a mission and a world: the one of `options` and `teammates`, who are
// like it but for name, start, seed and traits. Robots see each other and block each other's ways.
// In lockstep they take turns in the order of simulated time, so that the episode is repeatable;
// `stop` and all listeners are called by one robot at a time. In real time each goes its own
// way, and `stop` must be thread-safe. An error of one ends the episode for all.
absl::StatusOr<TeamResult> RunTeamEpisode(client::PlannerClient& planner, const SceneWorld& world,
                                          const EpisodeOptions& options,
                                          const std::vector<Teammate>& teammates,
                                          const StopFn& stop = NeverStop());

}  // namespace plumescout::lab
