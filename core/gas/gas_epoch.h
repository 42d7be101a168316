// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

#include "absl/status/statusor.h"
#include "core/gas/posterior.h"
#include "core/gas/reading_store.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/options.h"

namespace plumescout {

// A recomputation of the posterior from scratch on a copy of its inputs. No locks: whoever hands it
// to another thread orders the two.
class GasEpoch {
 public:
  struct Inputs {
    GasOptions options;
    ReadingStore readings;
    Grid<CellState> states;
    std::int64_t time_ns = 0;
  };
  explicit GasEpoch(Inputs inputs) : inputs_(std::move(inputs)) {}

  // On any thread; the second time it does nothing.
  void Recompute();
  bool done() const { return done_; }

  const Inputs& inputs() const { return inputs_; }
  // REQUIRES: done().
  const absl::StatusOr<Posterior>& posterior() const { return posterior_; }

 private:
  Inputs inputs_;
  bool done_ = false;
  absl::StatusOr<Posterior> posterior_;
};

}  // namespace plumescout
