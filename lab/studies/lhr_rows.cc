// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/lhr_rows.h"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "lab/trials/convergence.h"
#include "lab/worlds/lhr_scene.h"

namespace plumescout::lab {
namespace {

// [LHR] section IV-A.
constexpr double kSpeed_mps = 5.0;
constexpr double kDwell_s = 2.0;
constexpr double kUpdatePeriod_s = 50.0;
constexpr int kStride = 10;      // alpha
constexpr int kCandidates = 15;  // M
constexpr int kCycle = 10;       // T

// Section II-A: the variance of a reading is proportional to it. By how much is ours: one standard
// deviation is 1 ppm at 10 ppm; and readings below 1 ppm count as of 1 ppm.
constexpr DwellNoise kNoise{
    .sigma_ppm = 0.01, .share = 0.0, .variance_per_ppm = 0.1, .least_told_ppm2 = 0.1};
constexpr double kTimeLimit_s = 50'000.0;  // all rows end long before
constexpr double kJudgePeriod_s = 10.0;
constexpr double kSecondsPerMinute = 60.0;

}  // namespace

absl::StatusOr<StudyRow> MakeLhrStudyRow(const LhrRow& row, const LhrUnstated& unstated,
                                         const GridGeometry& geometry) {
  PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made, MakeStudyRow(row.name, row.strategy, true));
  made.mission.occupancy.inflation_radius_m = 0.0;  // open, and the robot is a point
  made.mission.gas.prior_precision_per_ppm2 = unstated.prior_precision_per_ppm2;
  PlanningOptions& planning = made.mission.planning;
  planning.beta = unstated.beta;
  planning.speed_mps = kSpeed_mps;
  planning.dwell_s = kDwell_s;
  planning.sites.region = RegionOf(geometry);
  planning.sites.spacing_m = geometry.resolution_m;
  planning.sites.reward = row.reward;
  planning.sites.survey = row.survey;
  planning.sites.survey_stride = kStride;
  planning.sites.candidate_count = kCandidates;
  planning.sites.cycle_sample_count = kCycle;
  planning.sites.update_period_s = kUpdatePeriod_s;
  return made;
}

SamplingPlan MakeLhrDrives(const ExperimentOptions& options, std::vector<Scene> worlds,
                           std::size_t corners) {
  SamplingPlan plan;
  plan.worlds = std::move(worlds);
  const std::array<Point2, 4> starts = LhrStarts();
  for (std::size_t world = 0; world < plan.worlds.size(); ++world) {
    for (std::size_t corner = 0; corner < corners; ++corner) {
      plan.cases.push_back({absl::StrCat("world_", world, "-corner_", corner),
                            world,
                            {starts[corner].x_m, starts[corner].y_m, 0.0},
                            options.seed + world * starts.size() + corner});
    }
  }
  plan.noise = kNoise;
  plan.first_dwell_s = kDwell_s;
  plan.time_limit_s = kTimeLimit_s;
  plan.judge_period_s = kJudgePeriod_s;
  plan.folder = absl::StrCat(options.folder, "/drives");
  plan.jobs = options.jobs;
  return plan;
}

double LhrDriven_m(const SamplingDrive& drive) { return drive.driven_m; }

double LhrConvergence_min(const SamplingDrive& drive, double band) {
  return ConvergenceTime_s(drive.errors, band).value_or(drive.elapsed_s) / kSecondsPerMinute;
}

double LhrConvergence_min(const SamplingDrive& drive) {
  return LhrConvergence_min(drive, kSteadyShare);
}

}  // namespace plumescout::lab
