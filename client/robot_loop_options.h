// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "client/blockage.h"
#include "client/ingest_session.h"
#include "client/join.h"
#include "client/motion.h"
#include "client/sensor_bridge.h"

namespace plumescout::client {

enum class Pacing {
  // The world waits for acknowledgements and plans, so that a run is repeatable and may be faster
  // than real time; planning costs plan_latency_s of the robot's time.
  kLockstep,
  // The robot goes on while it asks.
  kFreeRunning,
};

struct RobotLoopOptions {
  Participation participation;
  Pacing pacing = Pacing::kFreeRunning;
  Following following = Following::kProportional;
  SensorRates rates;  // no more than one reading of a sensor is taken in a tick
  GasSampling gas_sampling;
  FollowerOptions follower;  // its tick_s is set from the one below
  BlockageOptions blockage;  // its radius is set from the participation
  IngestOptions ingest;
  // Of a log that begins here, drawn at random by who runs the loop: in [0, 2^53). 0: the server is
  // not told which log it is; with a log on disk it has to be.
  std::int64_t new_log_epoch = 0;
  // The driver's clock goes as fast as time does, so batches say when they were sent by it, and it
  // need not be right. Not for simulations that run faster, or slower.
  bool real_clock = false;
  double tick_s = 0.1;  // between commands, > 0
  // Who stands and waits for a plan looks for it so often, > 0. Below a tick, which scans are taken
  // depends on how long plans take.
  double answer_look_s = 0.1;
  double look_around_s = 0.5;   // standing before the first plan: a cell takes 3 beams to be free
  double plan_latency_s = 0.1;  // lockstep only: robot time that a plan costs, >= 0
  // On its way a robot asks for a better plan this long after it has begun the last, >= 0, and goes
  // on meanwhile; 0: when it is there. None: as plans advise (Plan::replan_after_s).
  std::optional<double> replan_period_s;
  double stand_before_retry_s = 1.0;  // when there was nowhere to go, > 0
  double time_limit_s = 0.0;          // of the robot's clock; 0: none
  // Lockstep only: while it says so the world does not wait for acknowledgements, and the robot
  // stands when it would ask for a plan. Null: links that break are waited for.
  std::function<bool()> link_is_down = nullptr;
  // Heeds what the service tells unasked: that a plan does not stand, that the mission is paused or
  // finished, that the robot is to go home. Else it finds out when it asks.
  bool watch = true;
  std::int64_t max_edge_evaluations = 0;  // of each plan; for repeatable runs, see PlanRequest
  absl::Duration plan_budget = absl::Seconds(1);
  absl::Duration plan_timeout = absl::Seconds(10);
  // For joining, and in lockstep for each plan: how long a broken link is put up with.
  absl::Duration link_patience = absl::Seconds(60);
  absl::Duration drain_timeout = absl::Seconds(10);  // for the last acknowledgements
};

// kInvalidArgument naming the field.
absl::Status Validate(const RobotLoopOptions& options);

}  // namespace plumescout::client
