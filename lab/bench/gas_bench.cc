// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// The gas posterior from scratch: CPU time, memory, and error against other solvers, which are
// timed on the same maps in the same run.

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/belief_propagation.h"
#include "core/gas/gas_map.h"
#include "core/gas/gmrf_graph.h"
#include "core/gas/information.h"
#include "core/gas/reading_store.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/bench/bench_summary.h"
#include "lab/bench/bench_world.h"
#include "lab/bench/gas_peers.h"

namespace plumescout::lab {
namespace {

constexpr int kWidth_cells = 160;
constexpr int kHeight_cells = 200;
constexpr int kLargeSide_cells = 700;
constexpr int kSmallSide_cells = 40;  // for the dense inverse
constexpr int kReadings = 600;        // 300 s at 2 Hz
constexpr int kRepeats = 9;
constexpr int kRepeatsLarge = 3;

struct Case {
  Grid<CellState> states;
  std::vector<Point2> positions;  // of readings
  std::vector<double> concentrations_ppm;
};

Grid<CellState> OpenMap(int width, int height) {
  return Grid<CellState>(GridGeometry{0.0, 0.0, 0.1, width, height}, CellState::kFree);
}

Grid<CellState> IndoorMap(int width, int height, std::uint64_t seed) {
  const Grid<std::uint8_t> walls = MakeBuilding(width, height, seed);
  Grid<CellState> states(walls.geometry());
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i] = walls[i] != 0 ? CellState::kOccupied : CellState::kFree;
  }
  return states;
}

// Readings of a plume in the middle of the map, in random free cells.
Case MakeCase(Grid<CellState> states, std::uint64_t seed) {
  constexpr double kPeak_ppm = 50.0;
  constexpr double kNoise_ppm = 0.5;
  Rng rng(seed);
  Case c{std::move(states), {}, {}};
  const GridGeometry& geometry = c.states.geometry();
  const Point2 source = geometry.Center({geometry.width / 2, geometry.height / 2});
  const double width_m = geometry.width * geometry.resolution_m / 4.0;
  while (c.positions.size() < kReadings) {
    const Cell cell = geometry.CellAtIndex(rng.Below(c.states.size()));
    if (c.states[cell] != CellState::kFree) continue;
    const double distance = Distance_m(geometry.Center(cell), source) / width_m;
    c.positions.push_back(geometry.Center(cell));
    c.concentrations_ppm.push_back(kPeak_ppm * std::exp(-distance * distance) +
                                   kNoise_ppm * rng.Gaussian());
  }
  return c;
}

// A mission's gas map that has heard everything and computed nothing.
GasMap UnrefreshedMap(const Case& c) {
  GasMap map{GasOptions()};
  for (std::size_t k = 0; k < c.positions.size(); ++k) {
    map.Add(0, c.positions[k], {c.concentrations_ppm[k]});
  }
  return map;
}

absl::StatusOr<GasMap> FreshMap(const Case& c) {
  GasMap map = UnrefreshedMap(c);
  PLUMESCOUT_RETURN_IF_ERROR(map.Refresh(c.states, 0));
  return map;
}

absl::StatusOr<Information> InformationOf(const Case& c) {
  const GmrfGraph graph(c.states);
  ReadingStore store{GasOptions()};
  for (std::size_t k = 0; k < c.positions.size(); ++k) {
    store.Add(0, c.positions[k], {c.concentrations_ppm[k]});
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlacedReadings placed, store.PlaceAll(graph, 0));
  return BuildInformation(graph, placed.evidence, GasOptions());
}

// Placing the readings, assembly, ordering, factorisation, mean and all variances.
absl::Status MeasureFresh(const std::string& name, const Case& c, int repeats,
                          BenchSummary& summary) {
  absl::Status status;
  summary.Set(name, MedianCpu_ms(repeats, [&] { status.Update(FreshMap(c).status()); }));
  return status;
}

// The same without placing and assembly, in the peers' favour.
absl::Status MeasurePeers(const std::string& suffix, const Case& c, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Information information, InformationOf(c));
  absl::Status status;
  summary.Set("cholmod_fresh_" + suffix,
              MedianCpu_ms(kRepeats, [&] { status.Update(SolveByCholmod(information).status()); }));
  summary.Set("eigen_fresh_" + suffix,
              MedianCpu_ms(kRepeats, [&] { status.Update(SolveByEigen(information).status()); }));
  return status;
}

struct Errors {
  double mean_ppm = 0.0;
  double variance_relative = 0.0;

  // Of the published fields, floats, in every free cell.
  void Add(const GasMap& map, const PeerPosterior& truth) {
    std::size_t variable = 0;
    for (std::size_t i = 0; i < map.mean_ppm().size(); ++i) {
      if (std::isnan(map.mean_ppm()[i])) continue;
      const double mean_error = map.mean_ppm()[i] - truth.deviation_ppm[variable];
      const double ratio = map.variance_ppm2()[i] / truth.variance_ppm2[variable];
      mean_ppm = std::max(mean_ppm, std::abs(mean_error));
      variance_relative = std::max(variance_relative, std::abs(ratio - 1.0));
      ++variable;
    }
  }
};

// Against the dense inverse on small maps, against CHOLMOD in every cell of the large ones.
absl::Status MeasureErrors(const std::vector<Case>& small, const std::vector<Case>& large,
                           BenchSummary& summary) {
  Errors errors;
  for (const Case& c : small) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const GasMap map, FreshMap(c));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Information information, InformationOf(c));
    errors.Add(map, SolveDensely(information));
  }
  for (const Case& c : large) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const GasMap map, FreshMap(c));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Information information, InformationOf(c));
    PLUMESCOUT_ASSIGN_OR_RETURN(const PeerPosterior truth, SolveByCholmod(information));
    errors.Add(map, truth);
  }
  summary.Set("max_mean_error_ppm", errors.mean_ppm);
  summary.Set("max_variance_relative_error", errors.variance_relative);
  return absl::OkStatus();
}

// The papers' solver, from nothing until its variances have settled, and how far it then is from
// the exact field.
absl::Status MeasureBeliefPropagation(const Case& c, BenchSummary& summary) {
  constexpr std::int64_t kSendsPerCell = 100;
  const GmrfGraph graph(c.states);
  ReadingStore store{GasOptions()};
  for (std::size_t k = 0; k < c.positions.size(); ++k) {
    store.Add(0, c.positions[k], {c.concentrations_ppm[k]});
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlacedReadings placed, store.PlaceAll(graph, 0));
  PLUMESCOUT_ASSIGN_OR_RETURN(const PeerPosterior truth,
                              SolveByCholmod(BuildInformation(graph, placed.evidence, {})));
  BeliefPropagation propagation(graph, {}, {.schedule = MessageSchedule::kWildfire});
  for (int i = 0; i < graph.variables(); ++i) {
    const auto variable = static_cast<VariableIndex>(i);
    propagation.SetEvidence(variable, placed.evidence[ToSize(variable)]);
  }
  summary.Set("gbp_100_sweeps_indoor_160x200_ms",
              MedianCpu_ms(1, [&] { propagation.Propagate(kSendsPerCell * graph.variables()); }));
  const Posterior beliefs = propagation.Beliefs();
  std::vector<double> ratios;
  double mean_error_ppm = 0.0;
  for (std::size_t i = 0; i < beliefs.mean_ppm.size(); ++i) {
    ratios.push_back(beliefs.variance_ppm2[i] / truth.variance_ppm2[i]);
    mean_error_ppm =
        std::max(mean_error_ppm, std::abs(beliefs.mean_ppm[i] - truth.deviation_ppm[i]));
  }
  summary.Set("gbp_variance_ratio_median", Median(ratios));
  summary.Set("gbp_max_mean_error_ppm", mean_error_ppm);
  return absl::OkStatus();
}

// A line of /proc/self/status, in MB; NaN if there is none.
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

// By how much the process grows, at most, while a map is refreshed.
absl::Status MeasureMemory(const std::string& name, const Case& c, BenchSummary& summary) {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // resets the peak
  const double before_mb = ProcessMemory_mb("VmRSS:");
  PLUMESCOUT_RETURN_IF_ERROR(FreshMap(c).status());
  summary.Set(name, ProcessMemory_mb("VmHWM:") - before_mb);
  return absl::OkStatus();
}

absl::Status Run(BenchSummary& summary) {
  const std::uint64_t seed = summary.seed();
  const Case open = MakeCase(OpenMap(kWidth_cells, kHeight_cells), seed);
  const Case indoor = MakeCase(IndoorMap(kWidth_cells, kHeight_cells, seed), seed);
  const Case large = MakeCase(OpenMap(kLargeSide_cells, kLargeSide_cells), seed);
  const Case small = MakeCase(OpenMap(kSmallSide_cells, kSmallSide_cells), seed);
  const Case small_indoor = MakeCase(IndoorMap(kSmallSide_cells, kSmallSide_cells, seed), seed);

  PLUMESCOUT_RETURN_IF_ERROR(MeasureMemory("memory_160x200_mb", open, summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureMemory("memory_700x700_mb", large, summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureFresh("fresh_160x200_ms", open, kRepeats, summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasurePeers("160x200_ms", open, summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureFresh("fresh_indoor_160x200_ms", indoor, kRepeats, summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasurePeers("indoor_160x200_ms", indoor, summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureFresh("fresh_700x700_ms", large, kRepeatsLarge, summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureBeliefPropagation(indoor, summary));
  return MeasureErrors({small, small_indoor}, {open, indoor}, summary);
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  CLI::App app("Times the gas posterior and compares it with other exact solvers");
  return plumescout::lab::RunBench(app, argc, argv, plumescout::lab::Run);
}
