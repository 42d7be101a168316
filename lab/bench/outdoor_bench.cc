// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// What missions over open ground cost: a robot with a lidar of 95 m drives through fenced fields of
// several sizes, with default options. CPU time of each scan with all that the gas field needs
// after it, memory as the process has it and as the mission reckons it, the worst legal scan, and
// what the parts of a mission take by which it reckons.

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/gas/field_bytes.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/mission.h"
#include "core/occupancy/scan_inserter.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/about/cpu_time.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"

namespace plumescout::lab {
namespace {

constexpr double kRange_m = 95.0;
constexpr int kBeams = 720;

// The defaults, with room for the largest field.
MissionOptions Options() {
  MissionOptions options;
  options.occupancy.max_extent_m = 250.0;
  options.occupancy.max_cell_count = 6'000'000;
  return options;
}

// Resident memory, now and at most since the last call of ResetPeak, MB.
double ProcessMemory_mb(const std::string& key) {
  constexpr double kMegabytesPerKibibyte = 1024e-6;
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) == 0) {
      return std::stod(line.substr(key.size())) * kMegabytesPerKibibyte;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double ResetPeak_mb() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  return ProcessMemory_mb("VmRSS:");
}

// Of a robot in a field of side x side metres with a fence, its corner at (0, 0).
Scan ScanInField(const Pose2& pose, double side_m) {
  Scan scan{-M_PI, 2.0 * M_PI / kBeams, kRange_m, {}};
  for (int beam = 0; beam < kBeams; ++beam) {
    const double bearing_rad = pose.yaw_rad + scan.start_angle_rad + beam * scan.angle_step_rad;
    const double c = std::cos(bearing_rad);
    const double s = std::sin(bearing_rad);
    const double to_x_m = ((c > 0.0 ? side_m : 0.0) - pose.x_m) / c;
    const double to_y_m = ((s > 0.0 ? side_m : 0.0) - pose.y_m) / s;
    const double range_m = std::min(to_x_m, to_y_m);
    scan.ranges_m.push_back(range_m <= kRange_m ? static_cast<float>(range_m)
                                                : std::numeric_limits<float>::infinity());
  }
  return scan;
}

// Serpentines through the field with 1.25 m/s, scans at 1 Hz: ten times as many would each cost
// less. A reading after each.
absl::Status DriveThrough(double side_m, int scans, const MissionOptions& options,
                          const std::string& name, BenchSummary& summary) {
  constexpr std::int64_t kStep_ns = 1'000'000'000;
  constexpr double kStep_m = 1.25;
  constexpr double kMargin_m = 3.0;
  constexpr double kApart_m = 20.0;
  const double before_mb = ResetPeak_mb();
  PLUMESCOUT_ASSIGN_OR_RETURN(auto mission, Mission::Create(options));
  MissionConduct conduct(std::move(mission));
  PLUMESCOUT_RETURN_IF_ERROR(conduct.Register(RobotRegistered{"a", 0.2, 1}).status());
  const double leg_m = side_m - 2.0 * kMargin_m;
  std::vector<double> scan_ms;
  std::int64_t sequence = 0;
  std::int64_t refused = 0;
  std::shared_ptr<const Belief> held;  // as watchers do
  for (int k = 0; k < scans; ++k) {
    const double way_m = kStep_m * k;
    const int leg = static_cast<int>(way_m / leg_m);
    const double along_m = way_m - leg * leg_m;
    const double y_m = std::min(kMargin_m + kApart_m * leg, side_m - kMargin_m);
    const Pose2 pose{leg % 2 == 0 ? kMargin_m + along_m : side_m - kMargin_m - along_m, y_m, 0.0};
    const Scan scan = ScanInField(pose, side_m);
    std::vector<IncomingObservation> batch(2);
    batch[0].observation = {++sequence, (k + 1) * kStep_ns, pose, scan};
    batch[1].observation = {++sequence, (k + 1) * kStep_ns + 1000, pose, GasReading{3.0, 0.0}};
    const double begin_ms = ThreadCpu_ms();
    const IngestResult result = conduct.Ingest("a", 1, std::move(batch));
    scan_ms.push_back(ThreadCpu_ms() - begin_ms);
    refused += static_cast<std::int64_t>(result.refused.size());
    if (k % 5 == 0) held = conduct.Snapshot();
  }
  summary.Set(name + "_scan_p50_ms", Median(scan_ms));
  summary.Set(name + "_scan_max_ms", *std::max_element(scan_ms.begin(), scan_ms.end()));
  double sum_ms = 0.0;
  for (const double ms : scan_ms) sum_ms += ms;
  summary.Set(name + "_scan_mean_ms", sum_ms / static_cast<double>(scans));
  summary.Set(name + "_memory_peak_mb", ProcessMemory_mb("VmHWM:") - before_mb);
  summary.Set(name + "_memory_reckoned_mb",
              static_cast<double>(conduct.mission().memory_bytes()) / 1e6);
  summary.Set(name + "_lattice_factor", conduct.mission().lattice_factor());
  summary.Set(name + "_refused", static_cast<double>(refused));
  const double begin_ms = ThreadCpu_ms();
  held = nullptr;
  held = conduct.Snapshot();
  summary.Set(name + "_snapshot_ms", ThreadCpu_ms() - begin_ms);
  return absl::OkStatus();
}

// As many beams as all may be, as long as they may be together, over ground that is mapped.
absl::Status MeasureWorstScan(BenchSummary& summary) {
  constexpr double kReach_m = 99.0;
  constexpr int kRepeats = 15;
  const MissionOptions mission = Options();
  for (const double opening_rad : {2.0 * M_PI, 0.5, 1e-3}) {
    OccupancyGrid grid(mission.occupancy);
    ScanInserter inserter;
    // Mean of |cos| + |sin| by the opening; the narrow ones point north-east, where that is
    // largest.
    const double crossed = opening_rad > 1.0 ? 4.0 / M_PI : std::sqrt(2.0);
    const double cells = crossed * kReach_m / mission.occupancy.resolution_m;
    const auto beams =
        std::min<std::size_t>(static_cast<std::size_t>(mission.max_beam_count),
                              static_cast<std::size_t>(ScanInserter::kMostCrossings / cells) - 1);
    const Scan scan{M_PI / 4.0 - opening_rad / 2.0, opening_rad / static_cast<double>(beams),
                    kReach_m, std::vector<float>(beams, std::numeric_limits<float>::infinity())};
    absl::Status status;
    const double cpu_ms = MedianCpu_ms(kRepeats, [&] {
      status.Update(inserter.Insert({0.03, 0.04, 0.0}, scan, {}, grid));
    });
    PLUMESCOUT_RETURN_IF_ERROR(status);
    const std::string name = absl::StrCat("worst_scan_", opening_rad, "_rad");
    summary.Set(name + "_beams", static_cast<double>(beams));
    summary.Set(name + "_ms", cpu_ms);
  }
  return absl::OkStatus();
}

// Peak of a field on open ground through a refresh, an epoch, an audit and its copies, by cell.
absl::Status MeasureFieldBytes(BenchSummary& summary) {
  for (const int side : {180, 300, 550}) {
    const double before_mb = ResetPeak_mb();
    {
      GasMap map{GasOptions()};
      Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, side, side}, CellState::kFree);
      map.Add(0, {1.0, 1.0}, {5.0});
      PLUMESCOUT_RETURN_IF_ERROR(map.Refresh(states, 0));
      const auto held = map.what_if();
      states[Cell{side / 2, side / 2}] = CellState::kOccupied;
      PLUMESCOUT_RETURN_IF_ERROR(map.Refresh(states, 0));
      PLUMESCOUT_RETURN_IF_ERROR(map.BeginEpoch(0));
      map.epoch()->Recompute();
      PLUMESCOUT_RETURN_IF_ERROR(map.Adopt());
      const double growth_mb = ProcessMemory_mb("VmHWM:") - before_mb;
      const std::string name = absl::StrCat("field_", side, "x", side);
      summary.Set(name + "_peak_mb", growth_mb);
      summary.Set(name + "_reckoned_mb", static_cast<double>(map.field_bytes()) / 1e6);
      PLUMESCOUT_RETURN_IF_ERROR(RunAudit(*map.MakeAudit()).status());
      summary.Set(name + "_peak_with_audit_mb", ProcessMemory_mb("VmHWM:") - before_mb);
    }
    // Rows of inactive cells around a small field: what the lattice alone takes.
    const double again_mb = ResetPeak_mb();
    GasMap sparse{GasOptions()};
    Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, 2 * side, 2 * side}, CellState::kUnknown);
    for (const Cell cell : {Cell{0, 0}, Cell{2 * side - 1, 2 * side - 1}}) {
      states[cell] = CellState::kFree;
    }
    PLUMESCOUT_RETURN_IF_ERROR(sparse.Refresh(states, 0));
    PLUMESCOUT_RETURN_IF_ERROR(sparse.BeginEpoch(0));
    sparse.epoch()->Recompute();
    PLUMESCOUT_RETURN_IF_ERROR(sparse.Adopt());
    summary.Set(absl::StrCat("lattice_", 2 * side, "x", 2 * side, "_peak_mb"),
                ProcessMemory_mb("VmHWM:") - again_mb);
    summary.Set(absl::StrCat("lattice_", 2 * side, "x", 2 * side, "_reckoned_mb"),
                static_cast<double>(sparse.field_bytes()) / 1e6);
  }
  return absl::OkStatus();
}

// Readings of as many places, placed on a map and waiting for one.
absl::Status MeasureReadingBytes(BenchSummary& summary) {
  constexpr int kSide = 300;
  for (const bool placed : {false, true}) {
    const double before_mb = ResetPeak_mb();
    ReadingStore store(GasOptions(), 0.1);
    SampledCells sampled(0.1);
    for (int i = 0; i < kSide * kSide; ++i) {
      const Point2 place{0.05 + 0.1 * (i % kSide), 0.05 + 0.1 * (i / kSide)};
      store.Add(0, place, {1.0});
      sampled.Add(0, place);
    }
    if (placed) {
      const GridGeometry geometry{0.0, 0.0, 0.1, kSide, kSide};
      PLUMESCOUT_RETURN_IF_ERROR(store.Place(Grid<CellState>(geometry, CellState::kFree), {}));
      store.TakeChanged();
    }
    summary.Set(placed ? "reading_site_placed_bytes" : "reading_site_waiting_bytes",
                (ProcessMemory_mb("VmHWM:") - before_mb) * 1e6 / (kSide * kSide));
  }
  return absl::OkStatus();
}

absl::Status Run(bool whole, BenchSummary& summary) {
  PLUMESCOUT_RETURN_IF_ERROR(MeasureWorstScan(summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureReadingBytes(summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureFieldBytes(summary));
  for (const int side_m : {32, 100, 200}) {
    constexpr int kScans = 60;
    PLUMESCOUT_RETURN_IF_ERROR(
        DriveThrough(side_m, kScans, Options(), absl::StrCat("drive_", side_m, "m"), summary));
  }
  if (!whole) return absl::OkStatus();
  // Without reach or budget.
  constexpr int kFewScans = 12;
  MissionOptions options = Options();
  options.gas.field_reach_m = 0.0;
  options.memory_budget_bytes = 1'000'000'000'000;
  return DriveThrough(100.0, kFewScans, options, "whole_100m", summary);
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  bool whole = false;
  return plumescout::lab::BenchProgram(
             "What missions over open ground cost, and what their parts take in memory")
      .AddSwitch("--whole", whole, "Also the field of the whole map, which takes gigabytes")
      .Run(argc, argv, [&](plumescout::lab::BenchSummary& summary) {
        return plumescout::lab::Run(whole, summary);
      });
}
