// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/gas_recording.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "absl/time/time.h"
#include "core/types/event.h"
#include "core/types/status_macros.h"
#include "lab/local/local_planner_client.h"
#include "lab/sim/episode.h"
#include "lab/trials/study.h"
#include "ompl_planners/ompl_planner.h"

namespace plumescout::lab {
namespace {

constexpr double kNoRefresh_s = 3600.0;  // but when a plan asks for it

}  // namespace

std::optional<HeardPose> HeardIn(const Event& event) {
  const auto* received = std::get_if<ObservationReceived>(&event.body);
  if (received == nullptr) return std::nullopt;
  const Observation& observation = received->observation;
  HeardPose heard{observation.sample_time_ns, observation.pose, std::nullopt};
  if (const auto* reading = std::get_if<GasReading>(&observation.payload)) heard.reading = *reading;
  return heard;
}

absl::StatusOr<GasRecording> RecordGas(const SceneWorld& world, const MissionOptions& mission,
                                       std::uint64_t seed, double duration_s,
                                       bool mission_corrects_lag) {
  GasRecording recording;
  LocalOptions local;
  local.path_planners = MakeOmplPlanner;
  local.on_event = [&recording](const Event& event) {
    if (const auto heard = HeardIn(event)) recording.heard.push_back(*heard);
  };
  LocalPlannerClient planner(local);
  EpisodeOptions options;
  options.mission = "recording";
  options.create = mission;
  options.create->seed = seed;
  options.create->gas.refresh_period_s = kNoRefresh_s;
  options.duration_s = duration_s;
  options.metrics_period_s = duration_s;
  options.plan_budget = absl::InfiniteDuration();
  options.simulated.seed = seed;
  options.correct_gas_lag = false;
  options.mission_corrects_lag = mission_corrects_lag;
  options.end_margin_m = kStudiedEndMargin_m;
  PLUMESCOUT_RETURN_IF_ERROR(RunEpisode(planner, world, options).status());
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto belief, planner.GetBelief(options.mission));
  recording.states = *belief->occupancy;
  recording.response_time_s = options.simulated.gas_sensor.time_constant_s;
  return recording;
}

}  // namespace plumescout::lab
