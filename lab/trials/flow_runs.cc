// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/flow_runs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

std::vector<int> CavityCells(bool quick) {
  return quick ? std::vector<int>{8, 16, 32} : std::vector<int>{32, 64, 128};
}
std::vector<int> ChannelCells(bool quick) {
  return quick ? std::vector<int>{4, 8, 16} : std::vector<int>{8, 16, 32};
}
std::vector<int> StepCells(bool quick) {
  return quick ? std::vector<int>{4, 8} : std::vector<int>{6, 12, 24};
}

// Tells how much is done; a run costs about the fourth power of its cells across: twice as many
// each way, four times the steps.
class Progress {
 public:
  explicit Progress(const ExperimentOptions& options) : tell_(options.progress) {
    for (const int n : CavityCells(options.quick)) total_ += 2.0 * Cost(n);
    for (const int n : ChannelCells(options.quick)) total_ += Cost(n);
    for (const int n : StepCells(options.quick)) total_ += 2.0 * Cost(2 * n);
  }
  void Add(int cells) {
    done_ += Cost(cells);
    if (tell_) tell_(std::min(1.0, done_ / total_));
  }

 private:
  static double Cost(int cells) { return std::pow(cells, 4.0); }

  std::function<void(double)> tell_;
  double total_ = 0.0;
  double done_ = 0.0;
};

double RmsOff(const std::array<ProfilePoint, 15>& points, const std::vector<LineSample>& samples) {
  double squares = 0.0;
  int counted = 0;
  for (const ProfilePoint& point : points) {
    if (point.misprint) continue;
    const double error = Interpolate(samples, point.at) - point.speed;
    squares += error * error;
    ++counted;
  }
  return std::sqrt(squares / counted);
}

double Greatest(std::vector<LineSample> samples) {
  for (LineSample& sample : samples) sample.speed = -sample.speed;
  return -Least(samples);
}

absl::StatusOr<CavityRun> RunCavity(const GhiaCavity& ghia, int cells) {
  PLUMESCOUT_ASSIGN_OR_RETURN(SteadyFlow flow,
                              RunToSteady(CavityDomain(cells), 1.0 / ghia.reynolds));
  CavityRun run;
  run.cells = cells;
  run.u = CavityU(flow.velocity);
  run.v = CavityV(flow.velocity);
  run.u_rms = RmsOff(ghia.u, run.u);
  run.v_rms = RmsOff(ghia.v, run.v);
  run.least_u = Least(run.u);
  run.least_v = Least(run.v);
  run.greatest_v = Greatest(run.v);
  run.velocity = std::move(flow.velocity);
  return run;
}

absl::StatusOr<ChannelRun> RunChannel(int cells) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const SteadyFlow flow,
      RunToSteady(ChannelDomain(cells, kChannelLength), 1.0 / kChannelReynolds));
  ChannelRun run;
  run.cells = cells;
  run.entrance = EntranceLength(flow.velocity);
  for (int y = 0; y < cells; ++y) {
    const double at = (y + 0.5) / cells;
    const double speed = flow.velocity.u(flow.velocity.geometry().width, y);
    run.profile.push_back({at, speed});
    run.largest_error = std::max(run.largest_error, std::abs(speed - Parabola(at)));
  }
  return run;
}

absl::StatusOr<StepRun> RunStep(const Reattachment& published, int cells) {
  constexpr double kHydraulicDiameters = 2.0;  // of a channel, in its heights
  PLUMESCOUT_ASSIGN_OR_RETURN(
      SteadyFlow flow,
      RunToSteady(StepDomain(cells, kLengthBehindStep), kHydraulicDiameters / published.reynolds));
  const double length = ReattachmentLength(flow.velocity);
  return StepRun{published, cells, length, std::move(flow.velocity)};
}

}  // namespace

absl::StatusOr<FlowRuns> RunPublishedFlows(const ExperimentOptions& options) {
  Progress progress(options);
  FlowRuns results;
  for (const int cells : ChannelCells(options.quick)) {
    PLUMESCOUT_ASSIGN_OR_RETURN(results.channels.emplace_back(), RunChannel(cells));
    progress.Add(cells);
  }
  for (const Reattachment& published : kReattachments) {
    for (const int cells : StepCells(options.quick)) {
      PLUMESCOUT_ASSIGN_OR_RETURN(results.steps.emplace_back(), RunStep(published, cells));
      progress.Add(2 * cells);
    }
  }
  for (const GhiaCavity& ghia : kGhiaCavities) {
    CavityStudy& study = results.cavities.emplace_back(CavityStudy{ghia, {}});
    for (const int cells : CavityCells(options.quick)) {
      PLUMESCOUT_ASSIGN_OR_RETURN(study.runs.emplace_back(), RunCavity(ghia, cells));
      progress.Add(cells);
    }
  }
  return results;
}

}  // namespace plumescout::lab
