// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/gas/cell_runs.h"
#include "core/gas/field/field_engine.h"
#include "core/gas/gas_lattice.h"

namespace plumescout {

// How a field came about: it was made from scratch, then told changes. The fields of an engine
// depend, within their tolerance, on the way that they came; who goes it again has the same bits.
struct FieldOrigin {
  CellRuns cells;                                // of the lattice, when it was made
  std::vector<std::vector<CellChange>> changes;  // call by call
};

// Whether a field can be made from them: kInvalidArgument for evidence that no readings give, which
// only a damaged saved state has.
absl::Status CheckCells(std::span<const CellInput> cells);

// Errors: kInvalidArgument for cells that do not fill the lattice, or inputs that Apply would not
// take; kInternal and kCancelled as from FieldEngine::Apply. Cost: a fresh computation, and a pass
// for each call.
absl::StatusOr<std::unique_ptr<FieldEngine>> MakeField(const FieldOrigin& origin,
                                                       const GasLattice& lattice,
                                                       const FieldOptions& options);

}  // namespace plumescout
