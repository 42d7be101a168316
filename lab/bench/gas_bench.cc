// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// The gas posterior, from scratch and online: CPU time, memory, and error against other solvers,
// which are timed on the same maps in the same run.

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/belief_propagation.h"
#include "core/gas/field/field_engine.h"
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

// What the readings say of each variable.
absl::StatusOr<std::vector<Evidence>> PlaceReadings(const Case& c, const GmrfGraph& graph) {
  ReadingStore store{GasOptions()};
  for (std::size_t k = 0; k < c.positions.size(); ++k) {
    store.Add(0, c.positions[k], {c.concentrations_ppm[k]});
  }
  PLUMESCOUT_RETURN_IF_ERROR(store.Place(c.states, {}));
  std::vector<Evidence> evidence(static_cast<std::size_t>(graph.variables()));
  for (const AnchorCell cell : store.TakeChanged()) {
    evidence[ToSize(graph.At({cell.x, cell.y}))] = store.EvidenceAt(cell);
  }
  return evidence;
}

absl::StatusOr<Information> InformationOf(const Case& c) {
  const GmrfGraph graph(c.states);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Evidence> evidence, PlaceReadings(c, graph));
  return BuildInformation(graph, evidence, GasOptions());
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
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Evidence> evidence, PlaceReadings(c, graph));
  PLUMESCOUT_ASSIGN_OR_RETURN(const PeerPosterior truth,
                              SolveByCholmod(BuildInformation(graph, evidence, {})));
  BeliefPropagation propagation(graph, {}, {.schedule = MessageSchedule::kWildfire});
  for (int i = 0; i < graph.variables(); ++i) {
    const auto variable = static_cast<VariableIndex>(i);
    propagation.SetEvidence(variable, evidence[ToSize(variable)]);
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

constexpr std::size_t kReadingsBetweenScans = 2;  // as of four robots: 2 Hz each, scans at 10 Hz
constexpr std::size_t kWhatIfCells = 16;
constexpr int kOnlineRepeats = 60;

// A field that goes on from a case, with events as a mission has them.
class OnlineField {
 public:
  OnlineField(const Case& c, const std::vector<Evidence>& evidence, std::uint64_t seed)
      : c_(c), rng_(seed), cells_(c.states.size()) {
    const GmrfGraph graph(c.states);
    for (std::size_t i = 0; i < evidence.size(); ++i) {
      cells_[graph.cell_index(VariableIndex{static_cast<int>(i)})] = {
          true, evidence[i].precision, evidence[i].weighted_deviation};
    }
  }

  FieldEngine Fresh() const {
    const GasOptions gas;
    FieldOptions options;
    options.prior = {gas.prior_precision, gas.background_precision};
    return FieldEngine(static_cast<std::size_t>(c_.states.width()),
                       static_cast<std::size_t>(c_.states.height()), cells_, options);
  }

  std::size_t ActiveCell() {
    std::size_t cell = 0;
    do {
      cell = rng_.Below(cells_.size());
    } while (!cells_[cell].active);
    return cell;
  }

  std::vector<CellChange> Reading() {
    constexpr double kPeak_ppm = 50.0;
    const std::size_t cell = ActiveCell();
    const double precision = GasOptions().observation_precision;
    cells_[cell].precision += precision;
    cells_[cell].weighted_deviation += precision * rng_.Uniform(0.0, kPeak_ppm);
    return {{cell, cells_[cell]}};
  }

  // 40 cells within 3 m of a robot become free or cease to be.
  std::vector<CellChange> Scan() {
    constexpr int kFlips = 40;
    constexpr int kReach_cells = 30;
    const GridGeometry& geometry = c_.states.geometry();
    const Cell robot = geometry.CellAtIndex(ActiveCell());
    std::vector<CellChange> changes;
    while (changes.size() < kFlips) {
      const Cell cell{robot.x + Offset(kReach_cells), robot.y + Offset(kReach_cells)};
      if (!geometry.Contains(cell)) continue;
      CellInput& input = cells_[geometry.Index(cell)];
      input.active = !input.active;
      changes.push_back({geometry.Index(cell), input});
    }
    return changes;
  }

  const std::vector<CellInput>& cells() const { return cells_; }

 private:
  int Offset(int reach) {
    return static_cast<int>(rng_.Below(static_cast<std::uint64_t>(2 * reach + 1))) - reach;
  }

  const Case& c_;
  Rng rng_;
  std::vector<CellInput> cells_;
};

// Worst difference between the field as the events have left it and one from scratch.
FieldError Drift(const OnlineField& online, const FieldEngine& field) {
  const FieldEngine fresh = online.Fresh();
  FieldError drift;
  for (std::size_t i = 0; i < online.cells().size(); ++i) {
    if (!online.cells()[i].active) continue;
    const double mean_ppm = std::abs(field.mean_ppm(i) - fresh.mean_ppm(i));
    const double ratio = field.variance_ppm2(i) / fresh.variance_ppm2(i);
    drift.mean_ppm = std::max(drift.mean_ppm, mean_ppm);
    drift.variance_ratio = std::max(drift.variance_ratio, std::abs(ratio - 1.0));
  }
  return drift;
}

// Of a field from scratch against CHOLMOD, in every cell.
absl::Status MeasureFieldError(const std::string& suffix, const Case& c, const OnlineField& online,
                               BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Information information, InformationOf(c));
  PLUMESCOUT_ASSIGN_OR_RETURN(const PeerPosterior truth, SolveByCholmod(information));
  const FieldEngine field = online.Fresh();
  Errors errors;
  std::size_t variable = 0;
  for (std::size_t i = 0; i < online.cells().size(); ++i) {
    if (!online.cells()[i].active) continue;
    const double ratio = field.variance_ppm2(i) / truth.variance_ppm2[variable];
    const double mean_error = std::abs(field.mean_ppm(i) - truth.deviation_ppm[variable++]);
    errors.mean_ppm = std::max(errors.mean_ppm, mean_error);
    errors.variance_relative = std::max(errors.variance_relative, std::abs(ratio - 1.0));
  }
  summary.Set("field_mean_error_ppm_" + suffix, errors.mean_ppm);
  summary.Set("field_variance_relative_error_" + suffix, errors.variance_relative);
  return absl::OkStatus();
}

double Cpu_ms(const std::function<void()>& run) {
  const double begin_ms = ThreadCpu_ms();
  run();
  return ThreadCpu_ms() - begin_ms;
}

// The engine that goes on: from scratch, per reading, per scan, and per question to a snapshot.
absl::Status MeasureOnline(const std::string& suffix, const Case& c, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Evidence> evidence,
                              PlaceReadings(c, GmrfGraph(c.states)));
  OnlineField online(c, evidence, summary.seed());
  summary.Set("field_fresh_" + suffix, MedianCpu_ms(kRepeats, [&] { online.Fresh(); }));

  const std::string map = suffix.substr(0, suffix.rfind('_'));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureFieldError(map, c, online, summary));
  FieldEngine field = online.Fresh();
  absl::Status status;
  std::vector<double> reading_ms, scan_ms, what_if_ms;
  for (int repeat = 0; repeat < kOnlineRepeats; ++repeat) {
    for (std::size_t k = 0; k < kReadingsBetweenScans; ++k) {
      const std::vector<CellChange> reading = online.Reading();
      reading_ms.push_back(Cpu_ms([&] { status.Update(field.Apply(reading)); }));
    }
    const std::vector<CellChange> scan = online.Scan();
    scan_ms.push_back(Cpu_ms([&] { status.Update(field.Apply(scan)); }));
    std::vector<std::size_t> cells;
    while (cells.size() < kWhatIfCells) cells.push_back(online.ActiveCell());
    const double precision = GasOptions().observation_precision;
    what_if_ms.push_back(
        Cpu_ms([&] { status.Update(field.Snapshot().VarianceIfRead(cells, precision).status()); }));
  }
  summary.Set("reading_" + suffix, Median(reading_ms));
  summary.Set("scan_" + suffix, Median(scan_ms));
  summary.Set("whatif16_" + suffix, Median(what_if_ms));
  const FieldError drift = Drift(online, field);
  summary.Set("online_mean_error_ppm_" + map, drift.mean_ppm);
  summary.Set("online_variance_relative_error_" + map, drift.variance_ratio);
  return status;
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
  PLUMESCOUT_RETURN_IF_ERROR(MeasureOnline("160x200_ms", open, summary));
  PLUMESCOUT_RETURN_IF_ERROR(MeasureOnline("indoor_160x200_ms", indoor, summary));
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
