// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_epoch.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "absl/status/status.h"

namespace plumescout {
namespace {

// As std::max, but what is not a number counts as beyond measure.
void Raise(double& largest, double value) {
  if (!(value <= largest)) {
    largest = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  }
}

FieldDrift DriftBetween(const EpochInputs& live, const FieldEngine& fresh) {
  FieldDrift drift;
  for (std::size_t cell = 0; cell < live.lattice.size(); ++cell) {
    if (!fresh.input(cell).active) continue;
    const double variance_ppm2 = fresh.variance_ppm2(cell);
    Raise(drift.mean_ppm, std::abs(live.mean_ppm[cell] - fresh.mean_ppm(cell)));
    Raise(drift.variance_ratio, std::abs(live.variance_ppm2[cell] - variance_ppm2) / variance_ppm2);
  }
  return drift;
}

}  // namespace

GasEpoch::GasEpoch(EpochInputs inputs) : inputs_(std::move(inputs)) {
  origin_.cells = CellRuns(inputs_.cells);
  inputs_.cells = {};
}

void GasEpoch::Recompute() {
  if (done()) return;
  std::vector<CellInput> cells = origin_.cells.Cells();
  if (absl::Status status = CheckCells(cells); !status.ok()) {
    failure_ = std::move(status);
    return;
  }
  auto engine = std::make_unique<FieldEngine>(static_cast<std::size_t>(inputs_.lattice.width),
                                              static_cast<std::size_t>(inputs_.lattice.height),
                                              std::move(cells), inputs_.options);
  if (engine->abandoned()) return;
  if (inputs_.is_same_model) drift_ = DriftBetween(inputs_, *engine);
  if (!inputs_.aged.empty()) {
    absl::Status status = engine->Apply(inputs_.aged);
    if (engine->abandoned()) return;
    if (!status.ok()) {
      failure_ = std::move(status);
      return;
    }
  }
  engine_ = std::move(engine);
}

FieldOrigin GasEpoch::TakeOrigin() {
  if (!inputs_.aged.empty()) origin_.changes.push_back(std::move(inputs_.aged));
  return std::move(origin_);
}

}  // namespace plumescout
