// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/outdoor_drive.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/belief/belief.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/mission.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/about/cpu_time.h"
#include "lab/bench/process_memory.h"

namespace plumescout::lab {
namespace {

constexpr double kRange_m = 95.0;
constexpr int kBeams = 720;
constexpr double kSpeed_mps = 1.25;
constexpr double kReadings_hz = 2.0;
constexpr double kResponseTime_s = 0.5;

// Of a robot in a field of side x side metres from (0, 0), with a fence around it that lies in the
// middle of cells.
Scan ScanInField(const Pose2& pose, double side_m) {
  constexpr double kFence_m = 0.05;
  Scan scan{-M_PI, 2.0 * M_PI / kBeams, kRange_m, {}};
  for (int beam = 0; beam < kBeams; ++beam) {
    const double bearing_rad = pose.yaw_rad + scan.start_angle_rad + beam * scan.angle_step_rad;
    const double c = std::cos(bearing_rad);
    const double s = std::sin(bearing_rad);
    const double to_x_m = ((c > 0.0 ? side_m + kFence_m : -kFence_m) - pose.x_m) / c;
    const double to_y_m = ((s > 0.0 ? side_m + kFence_m : -kFence_m) - pose.y_m) / s;
    const double range_m = std::min(to_x_m, to_y_m);
    scan.ranges_m.push_back(range_m <= kRange_m ? static_cast<float>(range_m)
                                                : std::numeric_limits<float>::infinity());
  }
  return scan;
}

// The ground in squares, as many as it takes for each robot to have one.
class Ways {
 public:
  explicit Ways(const OutdoorDrive& drive)
      : columns_(static_cast<int>(std::ceil(std::sqrt(drive.robots)))),
        part_m_(drive.side_m / columns_) {}

  // Where the robot is after so long.
  Pose2 At(int robot, double time_s) const {
    constexpr double kMargin_m = 3.0;
    constexpr double kApart_m = 20.0;
    const double leg_m = part_m_ - 2.0 * kMargin_m;
    const double way_m = kSpeed_mps * time_s;
    // A leg, and the way over to the next.
    const int leg = static_cast<int>(way_m / (leg_m + kApart_m));
    const double along_m = way_m - leg * (leg_m + kApart_m);
    const double gone_m = leg % 2 == 0 ? std::min(along_m, leg_m) : std::max(0.0, leg_m - along_m);
    const double up_m = kApart_m * leg + std::max(0.0, along_m - leg_m);
    const double x_m = kMargin_m + gone_m;
    const double y_m = std::min(kMargin_m + up_m, part_m_ - kMargin_m);
    return {x_m + part_m_ * (robot % columns_), y_m + part_m_ * (robot / columns_), 0.0};
  }

 private:
  int columns_;
  double part_m_;
};

// What robots send, in turn, and what that cost.
class Fleet {
 public:
  Fleet(const OutdoorDrive& drive, MissionConduct& conduct)
      : drive_(drive),
        ways_(drive),
        conduct_(conduct),
        sequences_(static_cast<std::size_t>(drive.robots)),
        readings_(static_cast<std::size_t>(drive.robots)) {}

  absl::Status Register() {
    for (int robot = 0; robot < drive_.robots; ++robot) {
      RobotRegistered registration{NameOf(robot), 0.2, 1};
      GasSensor& sensor = registration.sensors.emplace_back();
      sensor.id = "gas";
      sensor.response_time_s = kResponseTime_s;
      PLUMESCOUT_RETURN_IF_ERROR(conduct_.Register(registration).status());
    }
    return absl::OkStatus();
  }

  // The robot's next scan, and its readings until the one after that.
  void ScanAndRead(int robot, int scan) {
    const double time_s = (scan + static_cast<double>(robot) / drive_.robots) / drive_.scan_hz;
    const Pose2 pose = ways_.At(robot, time_s);
    double cpu_ms = Send(robot, time_s, ScanInField(pose, drive_.side_m));
    int& readings = readings_[static_cast<std::size_t>(robot)];
    for (; readings < (scan + 1) / drive_.scan_hz * kReadings_hz; ++readings) {
      // A little later than the scan, where both are due.
      const double read_s = time_s + 1e-3 + readings / kReadings_hz - scan / drive_.scan_hz;
      cpu_ms += Send(robot, read_s, GasReading{3.0, 0.0});
    }
    scan_ms_.push_back(cpu_ms);
  }

  const std::vector<double>& scan_ms() const { return scan_ms_; }
  std::int64_t refused() const { return refused_; }

 private:
  static RobotId NameOf(int robot) { return absl::StrCat("robot", robot); }

  template <typename Sample>
  double Send(int robot, double time_s, Sample sample) {
    constexpr double kNanoseconds = 1e9;
    std::vector<IncomingObservation> batch(1);
    batch[0].observation = {++sequences_[static_cast<std::size_t>(robot)],
                            std::llround((1.0 + time_s) * kNanoseconds), ways_.At(robot, time_s),
                            std::move(sample)};
    const double begin_ms = ThreadCpu_ms();
    const IngestResult result = conduct_.Ingest(NameOf(robot), 1, std::move(batch));
    refused_ += static_cast<std::int64_t>(result.refused.size());
    return ThreadCpu_ms() - begin_ms;
  }

  OutdoorDrive drive_;
  Ways ways_;
  MissionConduct& conduct_;
  std::vector<std::int64_t> sequences_;
  std::vector<int> readings_;  // of each robot, so far
  std::vector<double> scan_ms_;
  std::int64_t refused_ = 0;
};

// Of the ground, the free cells that have more than the prior.
double ShareInField(const Belief& belief, const OutdoorDrive& drive) {
  const auto prior_ppm2 = static_cast<float>(OpenLatticeVariance_ppm2(belief.options->gas));
  const std::vector<float>& variances = belief.gas_variance_ppm2->values();
  const auto cells = std::count_if(variances.begin(), variances.end(), [&](float variance_ppm2) {
    return std::isfinite(variance_ppm2) && variance_ppm2 != prior_ppm2;
  });
  const double cell_m = belief.occupancy->geometry().resolution_m;
  return static_cast<double>(cells) * cell_m * cell_m / (drive.side_m * drive.side_m);
}

void TellTimes(const std::vector<double>& scan_ms, const OutdoorDrive& drive,
               const std::string& name, BenchSummary& summary) {
  constexpr double kNearlyAll = 0.99;
  const double sum_ms = std::accumulate(scan_ms.begin(), scan_ms.end(), 0.0);
  summary.Set(name + "_scan_p50_ms", Median(scan_ms));
  summary.Set(name + "_scan_mean_ms", sum_ms / static_cast<double>(scan_ms.size()));
  summary.Set(name + "_scan_p99_ms", Quantile(scan_ms, kNearlyAll));
  summary.Set(name + "_scan_max_ms", *std::max_element(scan_ms.begin(), scan_ms.end()));
  summary.Set(name + "_cpu_cores", sum_ms * 1e-3 * drive.scan_hz / drive.scans);
}

}  // namespace

absl::Status MeasureDrive(const OutdoorDrive& drive, const MissionOptions& options,
                          const std::string& name, BenchSummary& summary) {
  const double before_mb = ResetPeak_mb();
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(options));
  MissionConduct conduct(std::move(mission));
  Fleet fleet(drive, conduct);
  PLUMESCOUT_RETURN_IF_ERROR(fleet.Register());
  std::shared_ptr<const Belief> held;  // as watchers do
  for (int scan = 0; scan < drive.scans; ++scan) {
    for (int robot = 0; robot < drive.robots; ++robot) fleet.ScanAndRead(robot, scan);
    if (scan % 5 == 0) held = conduct.Snapshot();
  }
  TellTimes(fleet.scan_ms(), drive, name, summary);
  summary.Set(name + "_process_peak_mb", PeakMemory_mb());
  summary.Set(name + "_memory_peak_mb", PeakMemory_mb() - before_mb);
  summary.Set(name + "_memory_reckoned_mb",
              static_cast<double>(conduct.mission().memory_bytes()) / 1e6);
  summary.Set(name + "_lattice_factor", conduct.mission().lattice_factor());
  summary.Set(name + "_refused", static_cast<double>(fleet.refused()));
  const double begin_ms = ThreadCpu_ms();
  held = nullptr;
  held = conduct.Snapshot();
  summary.Set(name + "_snapshot_ms", ThreadCpu_ms() - begin_ms);
  summary.Set(name + "_field_share", ShareInField(*held, drive));
  return absl::OkStatus();
}

}  // namespace plumescout::lab
