// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_loop_options.h"

#include "core/types/checker.h"

namespace plumescout::client {

absl::Status Validate(const RobotLoopOptions& options) {
  const GasSampling& gas_sampling = options.gas_sampling;
  const std::int64_t least_epoch = options.ingest.store.folder.empty() ? 0 : 1;
  return Checker()
      .InRangeBelow("new_log_epoch", options.new_log_epoch, least_epoch, kLogEpochEnd)
      .Positive("tick_s", options.tick_s)
      .Positive("answer_look_s", options.answer_look_s)
      .Positive("radius_m", options.participation.radius_m)
      .NotNegative("replan_period_s", options.replan_period_s.value_or(0.0))
      .Positive("stand_before_retry_s", options.stand_before_retry_s)
      .NotNegative("look_around_s", options.look_around_s)
      .NotNegative("plan_latency_s", options.plan_latency_s)
      .NotNegative("time_limit_s", options.time_limit_s)
      .Finite("frame.mission_from_robot.x_m", options.participation.frame.mission_from_robot.x_m)
      .Finite("frame.mission_from_robot.y_m", options.participation.frame.mission_from_robot.y_m)
      .Finite("frame.mission_from_robot.yaw_rad",
              options.participation.frame.mission_from_robot.yaw_rad)
      .NotNegative("rates.scan_hz", options.rates.scan_hz)
      .NotNegative("rates.gas_hz", options.rates.gas_hz)
      .NotNegative("gas_sampling.time_constant_s", gas_sampling.time_constant_s)
      .NotNegative("gas_sampling.settling_s", gas_sampling.settling_s)
      .status();
}

}  // namespace plumescout::client
