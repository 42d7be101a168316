// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/gas/gmrf_graph.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// One value per variable, rounded to float; NaN off the free cells.
Grid<float> ToGrid(const GmrfGraph& graph, const std::vector<double>& values) {
  Grid<float> grid(graph.geometry(), std::numeric_limits<float>::quiet_NaN());
  for (int i = 0; i < graph.variables(); ++i) {
    grid[graph.cell_index(VariableIndex{i})] =
        static_cast<float>(values[static_cast<std::size_t>(i)]);
  }
  return grid;
}

}  // namespace

namespace {

constexpr std::int64_t kEpochPeriod_refreshes = 8;
constexpr std::int64_t kEpochLatency_ns = 500'000'000;

double LargestDifference(const Grid<float>& a, const Grid<float>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (!std::isnan(a[i]) && !std::isnan(b[i])) {
      largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    }
  }
  return largest;
}

}  // namespace

GasMap::GasMap(const GasOptions& options) : options_(options), readings_(options) {
  assert(Validate(options).ok());
}

void GasMap::Add(std::int64_t time_ns, Point2 position, const GasReading& reading) {
  readings_.Add(time_ns, position, reading);
  ++counters_.readings;
  ++counters_.waiting;
  stale_ = true;
}

absl::Status GasMap::Refresh(const Grid<CellState>& states, std::int64_t time_ns) {
  const GmrfGraph graph(states);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlacedReadings placed, readings_.PlaceAll(graph, time_ns));
  absl::StatusOr<Posterior> posterior = solver_.Solve(graph, placed.evidence, options_);
  if (!posterior.ok()) {
    return absl::InternalError(absl::StrCat("gas map: ", posterior.status().ToString()));
  }
  mean_ppm_ = ToGrid(graph, posterior->mean_ppm);
  variance_ppm2_ = ToGrid(graph, posterior->variance_ppm2);
  counters_ = placed.counters;
  stale_ = false;
  states_ = states;
  ++quality_.refreshes;
  quality_.aged_to_ns = time_ns;
  return absl::OkStatus();
}

bool GasMap::epoch_due(std::int64_t) const {
  return epoch_ == nullptr && quality_.refreshes - refreshes_at_begin_ >= kEpochPeriod_refreshes;
}

std::shared_ptr<GasEpoch> GasMap::BeginEpoch(std::int64_t time_ns) {
  epoch_ = std::make_shared<GasEpoch>(GasEpoch::Inputs{options_, readings_, states_, time_ns});
  refreshes_at_begin_ = quality_.refreshes;
  return epoch_;
}

bool GasMap::adoption_due(std::int64_t time_ns) const {
  return epoch_ != nullptr && time_ns - epoch_->inputs().time_ns >= kEpochLatency_ns;
}

absl::Status GasMap::Adopt() {
  if (epoch_ == nullptr) return absl::FailedPreconditionError("no epoch is under way");
  epoch_->Recompute();
  const auto epoch = std::exchange(epoch_, nullptr);
  PLUMESCOUT_RETURN_IF_ERROR(epoch->posterior().status());
  ++quality_.epochs;
  if (quality_.refreshes != refreshes_at_begin_) return absl::OkStatus();
  const GmrfGraph graph(states_);
  Grid<float> mean_ppm = ToGrid(graph, epoch->posterior()->mean_ppm);
  quality_.drift_mean_ppm = LargestDifference(mean_ppm, mean_ppm_);
  quality_.aged_to_ns = epoch->inputs().time_ns;
  mean_ppm_ = std::move(mean_ppm);
  variance_ppm2_ = ToGrid(graph, epoch->posterior()->variance_ppm2);
  return absl::OkStatus();
}

}  // namespace plumescout
