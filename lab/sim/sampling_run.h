// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/ingest_session.h"
#include "client/join.h"
#include "client/planner_client.h"
#include "core/types/gas_reading.h"
#include "core/types/map_snapshot.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/stop.h"
#include "lab/formats/scene.h"
#include "lab/sim/dwell_sensor.h"
#include "lab/sim/field_error.h"

namespace plumescout::lab {

// A robot that only stops and samples, as those of [LHR] and [IPP]: it drives exactly along its
// trajectories, reads gas where they tell it to stand, and has no other sensor. The mission should
// know the map.
struct SamplingRunOptions {
  client::Participation participation;  // `create`: the mission, if it is not there
  Pose2 start;
  double first_dwell_s = 2.0;    // of a reading at the start, before the first plan; 0: none
  double time_limit_s = 10'000;  // simulated, > 0; what would be sampled later is not
  // The map is judged after a sample that comes this much later than the last judgement, when a
  // plan has been followed, and at both ends; 0: after every sample.
  double judge_period_s = 0.0;
  double background_ppm = 0.0;  // what the map says where it has no estimate, see FieldRmse_ppm
  std::uint64_t seed = 1;       // of the sensor
  std::int64_t start_time_ns = 1'700'000'000'000'000'000;  // of the robot's clock; >= 0
  // Runs that are to be repeatable do not bound plans by time.
  absl::Duration plan_budget = absl::InfiniteDuration();
  absl::Duration plan_timeout = absl::Minutes(10);
  client::IngestOptions ingest;
  // Told of every plan, at the time of asking, and of every map that was judged; may be empty.
  std::function<void(double time_s, const Plan&)> on_plan;
  std::function<void(const ErrorPoint&, const MapSnapshot&)> on_map;
};

// kInvalidArgument naming the field.
absl::Status Validate(const SamplingRunOptions& options);

struct TakenSample {
  double time_s = 0.0;  // at the end of the dwell
  Point2 place;
  GasReading reading;
  double driven_m = 0.0;  // up to there

  friend bool operator==(const TakenSample&, const TakenSample&) = default;
};

enum class SamplingEnd {
  kMissionComplete,
  kTimeLimit,
  kNowhereToGo,  // a plan that takes no time, though the mission is not complete
  kStopped,
};

struct SamplingRecord {
  SamplingEnd end = SamplingEnd::kStopped;
  double elapsed_s = 0.0;
  double driven_m = 0.0;
  int plans = 0;  // received
  std::vector<TakenSample> samples;
  ErrorCurve errors;  // one point per judged map
};

// Runs the robot in simulated time, in lockstep: it waits for acknowledgements, plans and maps,
// which cost no simulated time. Over any PlannerClient; the same options against the same service
// give the same record. Errors: kInvalidArgument for options; those of Join, NextBestTrajectory,
// GetMap, and of a reading that the mission refuses.
absl::StatusOr<SamplingRecord> RunSampling(client::PlannerClient& planner, const Scene& truth,
                                           const DwellSensor& sensor,
                                           const SamplingRunOptions& options,
                                           const StopFn& stop = NeverStop());

}  // namespace plumescout::lab
