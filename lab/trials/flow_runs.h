// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "lab/sim/mac_field.h"
#include "lab/trials/study.h"
#include "lab/worlds/flow_cases.h"
#include "lab/worlds/published_flows.h"

namespace plumescout::lab {

inline constexpr double kChannelReynolds = 50.0;  // mean speed * height / nu
inline constexpr double kChannelLength = 8.0;     // some three times the entrance
inline constexpr double kLengthBehindStep = 16.0;

struct CavityRun {
  int cells = 0;
  std::vector<LineSample> u;
  std::vector<LineSample> v;
  double u_rms = 0.0;  // off Ghia's points, misprints left out
  double v_rms = 0.0;
  double least_u = 0.0;
  double least_v = 0.0;
  double greatest_v = 0.0;
  MacField velocity;
};

struct CavityStudy {
  GhiaCavity ghia;
  std::vector<CavityRun> runs;  // from coarse to fine
};

struct ChannelRun {
  int cells = 0;
  std::vector<LineSample> profile;  // at the end
  double largest_error = 0.0;       // off Poiseuille's parabola
  double entrance = 0.0;
};

struct StepRun {
  Reattachment published;
  int cells = 0;
  double length = 0.0;
  MacField velocity;
};

struct FlowRuns {
  std::vector<CavityStudy> cavities;
  std::vector<ChannelRun> channels;
  std::vector<StepRun> steps;  // by Reynolds number, from coarse to fine
};

// Poiseuille's parabola of mean 1.
inline double Parabola(double at) { return 6.0 * at * (1.0 - at); }

// Every published flow on several rasters. Errors: those of FlowSolver.
absl::StatusOr<FlowRuns> RunPublishedFlows(const ExperimentOptions& options);

}  // namespace plumescout::lab
