// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/field/field_engine.h"
#include "core/gas/field_origin.h"
#include "core/gas/gas_lattice.h"
#include "core/gas/prior_scale.h"

namespace plumescout {

// What an epoch starts from: the live engine at one moment.
struct EpochInputs {
  std::int64_t time_ns = 0;
  FieldOptions options;  // of the new engine, and where its prior comes from
  PriorScale prior_scale;
  bool is_same_model = true;     // the prior is that of the live engine
  GasLattice lattice;            // of the new engine
  std::vector<CellInput> cells;  // by its cells
  std::vector<CellChange> aged;  // evidence with the precisions of `time_ns`; none without ageing
  // The live fields on the new lattice, NaN off the active cells.
  std::vector<double> mean_ppm;
  std::vector<double> variance_ppm2;
};

// How far the live fields were from fresh ones.
struct FieldDrift {
  double mean_ppm = 0.0;        // largest difference
  double variance_ratio = 0.0;  // largest, as share of the fresh one
};

// The gas field from scratch, on a lattice with room to grow and a dissection that suits it: made
// beside the live one, which goes on meanwhile. Shares nothing with it.
class GasEpoch {
 public:
  explicit GasEpoch(EpochInputs inputs);

  // The long part; may run on any thread. Does nothing if it is done, and comes to nothing if
  // FieldOptions::stop ends it, or if evidence is none (of a damaged saved state).
  // Cost: a fresh computation, two with ageing.
  void Recompute();
  bool done() const { return engine_ != nullptr; }
  // Why it is not done.
  const absl::Status& failure() const { return failure_; }

  std::int64_t time_ns() const { return inputs_.time_ns; }
  const GasLattice& lattice() const { return inputs_.lattice; }
  const FieldPrior& prior() const { return inputs_.options.prior; }
  const PriorScale& prior_scale() const { return inputs_.prior_scale; }
  // None if the live fields are of another prior. REQUIRES: done().
  const std::optional<FieldDrift>& drift() const { return drift_; }
  std::unique_ptr<FieldEngine> TakeEngine() { return std::move(engine_); }
  // What that was made from. Nothing is left to recompute it.
  FieldOrigin TakeOrigin();

 private:
  EpochInputs inputs_;
  FieldOrigin origin_;  // without `aged`
  std::optional<FieldDrift> drift_;
  std::unique_ptr<FieldEngine> engine_;
  absl::Status failure_ = absl::CancelledError("an epoch is abandoned");
};

}  // namespace plumescout
