// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field_origin.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "core/types/status_macros.h"

namespace plumescout {

absl::Status CheckCells(std::span<const CellInput> cells) {
  if (std::all_of(cells.begin(), cells.end(), IsPossible)) return absl::OkStatus();
  return absl::InvalidArgumentError("the evidence of a cell is out of range");
}

absl::StatusOr<std::unique_ptr<FieldEngine>> MakeField(const FieldOrigin& origin,
                                                       const GasLattice& lattice,
                                                       const FieldOptions& options) {
  const bool fits = lattice.width > 0 && lattice.height > 0 &&
                    origin.cells.size() == lattice.size() &&
                    origin.cells.size() < std::numeric_limits<Slot>::max();
  if (!fits) return absl::InvalidArgumentError("a gas field is made from other cells");
  std::vector<CellInput> cells = origin.cells.Cells();
  PLUMESCOUT_RETURN_IF_ERROR(CheckCells(cells));
  auto engine = std::make_unique<FieldEngine>(static_cast<std::size_t>(lattice.width),
                                              static_cast<std::size_t>(lattice.height),
                                              std::move(cells), options);
  for (const std::vector<CellChange>& changes : origin.changes) {
    PLUMESCOUT_RETURN_IF_ERROR(engine->Apply(changes));
  }
  PLUMESCOUT_RETURN_IF_ERROR(engine->Apply({}));  // whether it is sound
  return engine;
}

}  // namespace plumescout
