// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/map_snapshot.h"
#include "core/types/pose2.h"
#include "lab/formats/scene.h"
#include "lab/sim/dwell_sensor.h"
#include "lab/sim/sampling_run.h"
#include "lab/trials/calibration_table.h"
#include "lab/trials/map_calibration.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {

// One drive of every row: in which world, from where, with which noise.
struct SamplingCase {
  std::string name;  // of files too
  std::size_t world = 0;
  Pose2 start;
  std::uint64_t seed = 1;  // of sensor and planner
};

// Robots that stop and sample in worlds whose map they know, by several strategies.
struct SamplingPlan {
  std::vector<StudyRow> rows;  // the worlds' maps are added to what the missions know
  std::vector<Scene> worlds;
  std::vector<SamplingCase> cases;
  DwellNoise noise;
  double first_dwell_s = 2.0;
  double time_limit_s = 10'000.0;
  double judge_period_s = 0.0;  // see SamplingRunOptions
  std::string folder;           // finished drives are kept here, and taken from here
  int jobs = 1;
  std::function<void(double)> progress = {};
};

// What is kept of a drive.
struct SamplingDrive {
  SamplingEnd end = SamplingEnd::kStopped;
  double elapsed_s = 0.0;
  double driven_m = 0.0;
  int samples = 0;
  std::optional<double> source_s;  // when the cell of a source was first sampled
  ErrorCurve errors;
  MapCalibration calibration;  // of the map at the end

  friend bool operator==(const SamplingDrive&, const SamplingDrive&) = default;
};

// By row and case; drives of one case are pairs between rows. Does not depend on the jobs.
// Errors: those of RunSampling, naming row and case; of files.
absl::StatusOr<std::vector<std::vector<SamplingDrive>>> RunSamplingStudy(const SamplingPlan& plan);

// The drives of one row, world by world. Worlds are independent of each other; drives through one
// world are not. A world without a drive has none.
std::vector<std::vector<SamplingDrive>> ByWorld(const SamplingPlan& plan,
                                                const std::vector<SamplingDrive>& row);

// A figure of the drives of one row: its mean in each world that has drives.
std::vector<double> MeansByWorld(const SamplingPlan& plan, const std::vector<SamplingDrive>& row,
                                 const std::function<double(const SamplingDrive&)>& figure);

// The maps that the drives end with, by row.
std::vector<RowMaps> FinalMaps(const SamplingPlan& plan,
                               const std::vector<std::vector<SamplingDrive>>& drives);

// One drive by itself, with everything that happened: for pictures.
struct SamplingWatch {
  std::function<void(double time_s, const Plan&)> on_plan;
  std::function<void(const ErrorPoint&, const MapSnapshot&)> on_map;
};
absl::StatusOr<SamplingRecord> RunSamplingCase(const SamplingPlan& plan, std::size_t row,
                                               std::size_t number, const SamplingWatch& watch = {});

}  // namespace plumescout::lab
