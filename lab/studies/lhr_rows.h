// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/grid_geometry.h"
#include "core/types/options.h"
#include "lab/formats/scene.h"
#include "lab/trials/sampling_study.h"
#include "lab/trials/study.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {

// A row of [LHR] Table II.
struct LhrRow {
  const char* name;
  const char* label;
  const char* strategy;
  SamplingReward reward;
  bool survey;
  double paper_distance_m;
  double paper_convergence_min;
};
inline constexpr std::array<LhrRow, 6> kLhrRows = {{
    {"sweep", "Sweep", "sweep", SamplingReward::kUcb, false, 2601, 95.33},
    {"crs", "CRS", "random_sampling", SamplingReward::kUcb, true, 34807, 202.72},
    {"lhr_mean", "LHR, mean", "lhr", SamplingReward::kMean, true, 15547, 46.71},
    {"lhr_ucb", "LHR, UCB", "lhr", SamplingReward::kUcb, true, 24065, 51.41},
    {"lhr_mean_no_survey", "mean, no survey", "lhr", SamplingReward::kMean, false, 9939, 78.07},
    {"lhr_ucb_no_survey", "UCB, no survey", "lhr", SamplingReward::kUcb, false, 21321, 49.13},
}};

// What the paper does not state of its field and its reward.
struct LhrUnstated {
  double prior_precision_per_ppm2 = 0.0;  // lambda_p
  double beta = 0.0;
};
// Those of all tables: what lhr_calibration found.
inline constexpr LhrUnstated kLhrUnstated = {.prior_precision_per_ppm2 = 5.0, .beta = 2.0};

// A row with all that the paper states, in worlds of this geometry. Errors: as MakeStudyRow.
absl::StatusOr<StudyRow> MakeLhrStudyRow(const LhrRow& row, const LhrUnstated& unstated,
                                         const GridGeometry& geometry);

// Drives from the first `corners` corners of the worlds, to the last site; the rows are left empty.
SamplingPlan MakeLhrDrives(const ExperimentOptions& options, std::vector<Scene> worlds,
                           std::size_t corners);

double LhrDriven_m(const SamplingDrive& drive);
// RMSE-CT: from when on the error stays within `band` of its final value.
double LhrConvergence_min(const SamplingDrive& drive, double band);
double LhrConvergence_min(const SamplingDrive& drive);  // of kSteadyShare

}  // namespace plumescout::lab
