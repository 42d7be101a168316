// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// The gas posterior, from scratch and online: CPU time, memory, and error against other solvers,
// which are timed on the same maps in the same run.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/gas/field_audit.h"
#include "core/gas/gas_map.h"
#include "core/types/quantile.h"
#include "core/types/status_macros.h"
#include "lab/about/cpu_time.h"
#include "lab/bench/bench_program.h"
#include "lab/bench/bench_summary.h"
#include "lab/bench/gas_case.h"
#include "lab/bench/gas_events.h"
#include "lab/bench/gas_peers.h"
#include "lab/bench/process_memory.h"
#include "lab/rivals/belief_propagation.h"

namespace plumescout::lab {
namespace {

// Names end in the size; those of the open map say so, all others are of the indoor one.
struct Size {
  int width_cells;
  int height_cells;
  int robots;   // that scan at once
  int repeats;  // of what takes long

  std::string Cells() const { return absl::StrCat(width_cells, "x", height_cells); }
  std::string Name(const std::string& what, bool open, const std::string& unit) const {
    return absl::StrCat(what, open ? "_open_" : "_", Cells(), "_", unit);
  }
};
constexpr Size kSizes[] = {{160, 200, 1, 9}, {320, 400, 2, 3}, {700, 700, 8, 1}};

constexpr int kReadingsBetweenScans = 2;  // as of four robots: 2 Hz each, scans at 10 Hz
constexpr std::size_t kWhatIfCells = 16;
constexpr std::size_t kPromised = 64;
constexpr int kScans = 60;

double Cpu_ms(const std::function<void()>& run) {
  const double begin_ms = ThreadCpu_ms();
  run();
  return ThreadCpu_ms() - begin_ms;
}

// By how much the process grows, at most, while a map is computed from scratch.
absl::Status MeasureMemory(const std::string& name, const GasCase& c, BenchSummary& summary) {
  const double before_mb = ResetPeak_mb();
  PLUMESCOUT_RETURN_IF_ERROR(FreshMap(c).status());
  summary.Set(name, PeakMemory_mb() - before_mb);
  return absl::OkStatus();
}

// Placing the readings, dissection, factorisation, mean and all variances; the peers without
// placing and assembly, in their favour.
absl::Status MeasureFresh(const Size& size, bool open, const GasCase& c, BenchSummary& summary) {
  absl::Status status;
  const auto measure = [&](const std::string& what, const std::function<absl::Status()>& run) {
    summary.Set(size.Name(what, open, "ms"),
                MedianCpu_ms(size.repeats, [&] { status.Update(run()); }));
  };
  measure("fresh", [&] { return FreshMap(c).status(); });
  PLUMESCOUT_ASSIGN_OR_RETURN(const Information information, InformationOf(c));
  measure("cholmod_fresh", [&] { return SolveByCholmod(information).status(); });
  measure("eigen_fresh", [&] { return SolveByEigen(information).status(); });
  return status;
}

// The papers' solver, from nothing until its variances have settled, and how far it then is from
// the exact field.
absl::Status MeasureBeliefPropagation(const Size& size, bool open, const GasCase& c,
                                      BenchSummary& summary) {
  constexpr std::int64_t kSendsPerCell = 100;
  const GmrfGraph graph(c.states);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Evidence> evidence, EvidenceOf(c, graph));
  PLUMESCOUT_ASSIGN_OR_RETURN(const PeerPosterior truth,
                              SolveByCholmod(BuildInformation(graph, evidence, {})));
  BeliefPropagation propagation(graph, {}, {.schedule = MessageSchedule::kWildfire});
  for (int i = 0; i < graph.variables(); ++i) {
    const auto variable = static_cast<VariableIndex>(i);
    propagation.SetEvidence(variable, evidence[ToSize(variable)]);
  }
  summary.Set(size.Name("gbp_100_sweeps", open, "ms"),
              Cpu_ms([&] { propagation.Propagate(kSendsPerCell * graph.variables()); }));
  if (open || size.repeats == 1) return absl::OkStatus();
  const Posterior beliefs = propagation.Beliefs();
  std::vector<double> ratios;
  double mean_error_ppm = 0.0;
  for (std::size_t i = 0; i < beliefs.mean_ppm.size(); ++i) {
    ratios.push_back(beliefs.variance_ppm2[i] / truth.variance_ppm2[i]);
    mean_error_ppm =
        std::max(mean_error_ppm, std::abs(beliefs.mean_ppm[i] - truth.deviation_ppm[i]));
  }
  summary.Set(size.Name("gbp_max_mean_error", open, "ppm"), mean_error_ppm);
  if (size.width_cells == kSizes[0].width_cells) {
    summary.Set("gbp_variance_ratio_median", Median(ratios));
  }
  return absl::OkStatus();
}

// The engine that goes on: per reading, per scan of all robots, and per question to a snapshot.
absl::Status MeasureOnline(const Size& size, bool open, const GasCase& c, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<CellInput> inputs, InputsOf(c));
  GasEvents events(static_cast<std::size_t>(size.width_cells), std::move(inputs), summary.seed());
  FieldEngine field = events.Fresh();
  absl::Status status;
  const double precision = GasOptions().observation_precision_per_ppm2;
  std::vector<double> reading_ms, scan_ms, what_if_ms;
  for (int scan = 0; scan < kScans; ++scan) {
    for (int k = 0; k < kReadingsBetweenScans; ++k) {
      const std::vector<CellChange> reading = events.Reading(size.robots);
      reading_ms.push_back(Cpu_ms([&] { status.Update(field.Apply(reading)); }));
    }
    const std::vector<CellChange> changes = events.Scan(size.robots);
    scan_ms.push_back(Cpu_ms([&] { status.Update(field.Apply(changes)); }));
    std::vector<std::size_t> cells;
    while (cells.size() < kWhatIfCells) cells.push_back(events.ActiveCell());
    what_if_ms.push_back(
        Cpu_ms([&] { status.Update(field.Snapshot().VarianceIfRead(cells, precision).status()); }));
  }
  // Apart: a question of so many readings would leave the next reading a cold cache.
  std::vector<double> given_ms;
  for (int i = 0; i < kScans; ++i) {
    std::vector<ForeseenReading> promised;
    while (promised.size() < kPromised) promised.push_back({events.ActiveCell(), precision});
    given_ms.push_back(Cpu_ms([&] { status.Update(field.Snapshot().Given(promised).status()); }));
  }
  summary.Set(size.Name("reading", open, "ms"), Median(reading_ms));
  summary.Set(size.Name("scan", open, "ms"), Median(scan_ms));
  summary.Set(size.Name("whatif16", open, "ms"), Median(what_if_ms));
  summary.Set(size.Name("given64", open, "ms"), Median(given_ms));
  return status;
}

// Readings that come from anywhere and say anything, and the same if none may pass over any cell.
absl::Status MeasureWorstReadings(const Size& size, bool open, const GasCase& c,
                                  BenchSummary& summary) {
  constexpr int kRounds = 20;
  constexpr int kUnpruned = 15;
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<CellInput> inputs, InputsOf(c));
  GasEvents events(static_cast<std::size_t>(size.width_cells), std::move(inputs), summary.seed());
  FieldEngine field = events.Fresh();
  absl::Status status;
  const auto read_ms = [&](FieldEngine& engine) {
    const std::vector<CellChange> reading = events.ReadingAnywhere();
    return Cpu_ms([&] { status.Update(engine.Apply(reading)); });
  };
  std::vector<double> anywhere_ms, unpruned_ms;
  for (int round = 0; round < kRounds; ++round) {
    for (int k = 0; k < kReadingsBetweenScans; ++k) anywhere_ms.push_back(read_ms(field));
    status.Update(field.Apply(events.Scan(size.robots)));
  }
  FieldEngine exact = events.Fresh({0.0, 0.0});
  for (int k = 0; k < kUnpruned; ++k) unpruned_ms.push_back(read_ms(exact));
  summary.Set(size.Name("reading_anywhere", open, "ms"), Median(anywhere_ms));
  summary.Set(size.Name("reading_unpruned", open, "ms"), Median(unpruned_ms));
  return status;
}

// Against CHOLMOD's textbook use, in every cell.
absl::StatusOr<FieldDeviation> ErrorToCholmod(const GasEvents& events, const FieldEngine& field) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PeerPosterior truth, SolveByCholmod(events.AsMatrix()));
  return events.ErrorOf(field, truth.deviation_ppm, truth.variance_ppm2);
}

absl::Status MeasureFreshError(const GasCase& c, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<CellInput> inputs, InputsOf(c));
  const GasEvents events(static_cast<std::size_t>(c.states.width()), std::move(inputs), 0);
  PLUMESCOUT_ASSIGN_OR_RETURN(const FieldDeviation error, ErrorToCholmod(events, events.Fresh()));
  summary.Set("fresh_mean_error_ppm", error.mean_ppm);
  summary.Set("fresh_variance_relative_error", error.variance_ratio);
  return absl::OkStatus();
}

void Raise(FieldDeviation& worst, const FieldDeviation& error) {
  worst.mean_ppm = std::max(worst.mean_ppm, error.mean_ppm);
  worst.variance_ratio = std::max(worst.variance_ratio, error.variance_ratio);
}

// How far the fields are from fresh ones, and from what CHOLMOD makes of the same readings, in the
// course of 10,000 events without an epoch.
absl::Status MeasureOnlineError(const GasCase& c, BenchSummary& summary) {
  constexpr int kEvents = 10'000;
  constexpr int kEventsPerScan = 5;
  constexpr int kEventsPerCheck = 500;
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<CellInput> inputs, InputsOf(c));
  GasEvents events(static_cast<std::size_t>(c.states.width()), std::move(inputs), summary.seed());
  FieldEngine field = events.Fresh();
  FieldDeviation worst, worst_to_cholmod, bound;
  double most_of_bound = 0.0;
  for (int event = 1; event <= kEvents; ++event) {
    PLUMESCOUT_RETURN_IF_ERROR(
        field.Apply(event % kEventsPerScan == 0 ? events.Scan(1) : events.ReadingAnywhere()));
    Raise(bound, field.error_bound());
    if (event % kEventsPerCheck != 0) continue;
    Raise(worst, events.ErrorOf(field));
    PLUMESCOUT_ASSIGN_OR_RETURN(const FieldDeviation error, ErrorToCholmod(events, field));
    Raise(worst_to_cholmod, error);
    most_of_bound = std::max({most_of_bound, error.mean_ppm / field.error_bound().mean_ppm,
                              error.variance_ratio / field.error_bound().variance_ratio});
  }
  summary.Set("max_mean_error_ppm", worst.mean_ppm);
  summary.Set("max_variance_relative_error", worst.variance_ratio);
  summary.Set("max_mean_error_to_cholmod_ppm", worst_to_cholmod.mean_ppm);
  summary.Set("max_variance_relative_error_to_cholmod", worst_to_cholmod.variance_ratio);
  summary.Set("max_share_of_certificate_to_cholmod", most_of_bound);
  summary.Set("certified_mean_error_ppm", bound.mean_ppm);
  summary.Set("certified_variance_relative_error", bound.variance_ratio);
  summary.Set("healed", static_cast<double>(field.healed()));
  if (most_of_bound <= 1.0) return absl::OkStatus();
  return absl::InternalError(absl::StrCat("max_share_of_certificate_to_cholmod = ", most_of_bound,
                                          ": the field is farther off than it certifies"));
}

// An audit as a server has it made after an epoch: the writer's copy, and the rest beside it.
absl::Status MeasureAudit(const Size& size, bool open, const GasCase& c, BenchSummary& summary) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const GasMap map, FreshMap(c));
  absl::Status status;
  std::shared_ptr<const AuditInputs> moment;
  summary.Set(size.Name("audit_copy", open, "ms"),
              MedianCpu_ms(size.repeats, [&] { moment = map.MakeAudit(); }));
  summary.Set(size.Name("audit", open, "ms"), MedianCpu_ms(size.repeats, [&] {
                const auto finding = RunAudit(*moment);
                status.Update(finding.status());
                if (finding.ok() && !finding->certified) {
                  status.Update(absl::InternalError("an audit found more than was certified"));
                }
              }));
  return status;
}

// An epoch: what the writer has to do before and after, the rest beside it; and what it is before
// where precisions are learned, with a step of them.
absl::Status MeasureEpoch(const Size& size, bool open, const GasCase& c, BenchSummary& summary) {
  for (const auto precisions : {GasPrecisions::kFixed, GasPrecisions::kLearned}) {
    const bool learns = precisions == GasPrecisions::kLearned;
    GasOptions options;
    options.precisions = precisions;
    std::vector<double> begin_ms;
    std::vector<double> recompute_ms;
    std::vector<double> adopt_ms;
    absl::Status status;
    for (int i = 0; i < size.repeats; ++i) {
      GasMap map(options);
      for (std::size_t k = 0; k < c.positions.size(); ++k) {
        map.Add(0, c.positions[k], {c.concentrations_ppm[k]});
      }
      status.Update(map.Refresh(c.states, 0));
      begin_ms.push_back(Cpu_ms([&] { status.Update(map.BeginEpoch(0)); }));
      PLUMESCOUT_RETURN_IF_ERROR(status);
      recompute_ms.push_back(Cpu_ms([&] { map.epoch()->Recompute(); }));
      adopt_ms.push_back(Cpu_ms([&] { status.Update(map.Adopt()); }));
      PLUMESCOUT_RETURN_IF_ERROR(status);
    }
    const std::string what = learns ? "learning_epoch" : "epoch";
    summary.Set(size.Name(what + "_begin", open, "ms"), Median(begin_ms));
    summary.Set(size.Name(what, open, "ms"), Median(recompute_ms));
    summary.Set(size.Name(what + "_adopt", open, "ms"), Median(adopt_ms));
  }
  return absl::OkStatus();
}

absl::Status MeasureSize(const Size& size, BenchSummary& summary) {
  for (const bool open : {false, true}) {
    const auto make = open ? OpenCase : IndoorCase;
    const GasCase c = make(size.width_cells, size.height_cells, summary.seed());
    PLUMESCOUT_RETURN_IF_ERROR(MeasureMemory(size.Name("memory", open, "mb"), c, summary));
    PLUMESCOUT_RETURN_IF_ERROR(MeasureFresh(size, open, c, summary));
    PLUMESCOUT_RETURN_IF_ERROR(MeasureOnline(size, open, c, summary));
    PLUMESCOUT_RETURN_IF_ERROR(MeasureWorstReadings(size, open, c, summary));
    PLUMESCOUT_RETURN_IF_ERROR(MeasureBeliefPropagation(size, open, c, summary));
    PLUMESCOUT_RETURN_IF_ERROR(MeasureAudit(size, open, c, summary));
    PLUMESCOUT_RETURN_IF_ERROR(MeasureEpoch(size, open, c, summary));
  }
  return absl::OkStatus();
}

absl::Status Measure(const std::string& map, BenchSummary& summary) {
  bool found = false;
  for (const Size& size : kSizes) {
    if (!map.empty() && map != size.Cells()) continue;
    PLUMESCOUT_RETURN_IF_ERROR(MeasureSize(size, summary));
    found = true;
  }
  if (!found) return absl::InvalidArgumentError("--map " + map + " is none of its sizes");
  if (!map.empty()) return absl::OkStatus();
  const GasCase indoor = IndoorCase(160, 200, summary.seed());
  PLUMESCOUT_RETURN_IF_ERROR(MeasureFreshError(indoor, summary));
  return MeasureOnlineError(indoor, summary);
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  std::string map;
  return plumescout::lab::BenchProgram("Times the gas posterior and compares it with other solvers")
      .AddText("--map", map, "Only maps of this size, as 160x200, and no errors")
      .Run(argc, argv, [&map](plumescout::lab::BenchSummary& summary) {
        return plumescout::lab::Measure(map, summary);
      });
}
