// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace plumescout {

// What a gas field takes in memory, reckoned from its active cells and those of its lattice: the
// engine, a second one while an epoch is recomputed, the copies that snapshots and epochs make, and
// an audit. Measured on open ground, where separators are longest, at 32,000 to 300,000 cells (3.2
// to 4.4 KB each); rooms take half of it (docs/performance.md).
constexpr std::int64_t FieldBytes(std::int64_t active_cells, std::int64_t lattice_cells) {
  constexpr std::int64_t kLatticeCellBytes = 280;
  constexpr std::int64_t kLeastActiveCellBytes = 2000;
  // Every doubling of the field adds the separators of one more level.
  constexpr std::int64_t kBytesPerLevel = 366;
  constexpr std::int64_t kOffsetBytes = 2300;
  const auto levels =
      static_cast<std::int64_t>(std::bit_width(static_cast<std::uint64_t>(active_cells)));
  const std::int64_t active_cell_bytes =
      std::max(kLeastActiveCellBytes, kBytesPerLevel * levels - kOffsetBytes);
  return active_cell_bytes * active_cells + kLatticeCellBytes * lattice_cells;
}

}  // namespace plumescout
