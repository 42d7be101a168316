// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// What missions over open ground cost: robots with lidars of 95 m drive through fenced fields of
// several sizes, with default options. CPU time of each scan with all that the gas field needs
// after it, memory as the process has it and as the mission reckons it, the worst legal scan, and
// what the parts of a mission take by which it reckons.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/belief/sampled_cells.h"
#include "core/gas/field_audit.h"
#include "core/gas/gas_map.h"
#include "core/gas/reading_store.h"
#include "core/occupancy/scan_inserter.h"
#include "core/types/status_macros.h"
#include "lab/about/cpu_time.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"
#include "lab/bench/coarse_field.h"
#include "lab/bench/outdoor_drive.h"
#include "lab/bench/process_memory.h"

namespace plumescout::lab {
namespace {

struct Choice {
  bool whole = false;
  bool drives_only = false;
  bool coarse_only = false;
  int robots = 4;
  int scans = 60;
  int budget_mib = 512;
};

// The defaults, with room for the largest field.
MissionOptions Options() {
  MissionOptions options;
  options.occupancy.max_extent_m = 250.0;
  options.occupancy.max_cell_count = 6'000'000;
  return options;
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
      const double growth_mb = PeakMemory_mb() - before_mb;
      const std::string name = absl::StrCat("field_", side, "x", side);
      summary.Set(name + "_peak_mb", growth_mb);
      summary.Set(name + "_reckoned_mb", static_cast<double>(map.field_bytes()) / 1e6);
      PLUMESCOUT_RETURN_IF_ERROR(RunAudit(*map.MakeAudit()).status());
      summary.Set(name + "_peak_with_audit_mb", PeakMemory_mb() - before_mb);
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
                PeakMemory_mb() - again_mb);
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
                (PeakMemory_mb() - before_mb) * 1e6 / (kSide * kSide));
  }
  return absl::OkStatus();
}

absl::Status MeasureCoarse(BenchSummary& summary) {
  for (const double side_m : {32.0, 60.0}) {
    PLUMESCOUT_RETURN_IF_ERROR(MeasureCoarseFields(side_m, summary));
  }
  return absl::OkStatus();
}

absl::Status MeasureDrives(const Choice& choice, BenchSummary& summary) {
  for (const int side_m : {32, 100, 200}) {
    PLUMESCOUT_RETURN_IF_ERROR(MeasureDrive({.side_m = static_cast<double>(side_m)}, Options(),
                                            absl::StrCat("drive_", side_m, "m"), summary));
  }
  MissionOptions options = Options();
  options.memory_budget_bytes = std::int64_t{choice.budget_mib} << 20;
  OutdoorDrive team{.robots = choice.robots, .scans = choice.scans};
  const std::string name = absl::StrCat("drive_200m_", choice.robots, "_robots");
  PLUMESCOUT_RETURN_IF_ERROR(MeasureDrive(team, options, name, summary));
  constexpr double kUsualScans_hz = 10.0;
  team.scan_hz = kUsualScans_hz;
  return MeasureDrive(team, options, name + "_10hz", summary);
}

absl::Status Run(const Choice& choice, BenchSummary& summary) {
  if (choice.coarse_only) return MeasureCoarse(summary);
  if (choice.drives_only) return MeasureDrives(choice, summary);
  PLUMESCOUT_RETURN_IF_ERROR(MeasureWorstScan(summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureReadingBytes(summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureFieldBytes(summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureCoarse(summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureDrives(choice, summary));
  if (!choice.whole) return absl::OkStatus();
  // Without reach or budget.
  MissionOptions options = Options();
  options.gas.field_reach_m = 0.0;
  options.memory_budget_bytes = 1'000'000'000'000;
  return MeasureDrive({.side_m = 100.0, .scans = 12}, options, "whole_100m", summary);
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  plumescout::lab::Choice choice;
  return plumescout::lab::BenchProgram(
             "What missions over open ground cost, and what their parts take in memory")
      .AddCount("--robots", choice.robots, "Of the mission of several in 200 x 200 m")
      .AddCount("--scans", choice.scans, "Of each of them")
      .AddCount("--budget", choice.budget_mib, "Its memory, MiB")
      .AddSwitch("--drives", choice.drives_only, "Only the missions")
      .AddSwitch("--coarse", choice.coarse_only, "Only the fields of coarser lattices")
      .AddSwitch("--whole", choice.whole, "Also the field of the whole map, which takes gigabytes")
      .Run(argc, argv, [&](plumescout::lab::BenchSummary& summary) {
        return plumescout::lab::Run(choice, summary);
      });
}
