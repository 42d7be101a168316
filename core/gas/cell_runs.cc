// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/cell_runs.h"

#include <cmath>
#include <limits>

namespace plumescout {
namespace {

bool IsSame(const CellInput& a, const CellInput& b) {
  return a == b && std::signbit(a.precision) == std::signbit(b.precision) &&
         std::signbit(a.weighted_deviation) == std::signbit(b.weighted_deviation);
}

}  // namespace

CellRuns::CellRuns(std::span<const CellInput> cells) : size_(cells.size()) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  for (const CellInput& cell : cells) {
    const bool continues =
        !runs_.empty() && runs_.back().cells < kMost && IsSame(runs_.back().input, cell);
    if (!continues) runs_.push_back({0, cell});
    ++runs_.back().cells;
  }
  runs_.shrink_to_fit();
}

std::vector<CellInput> CellRuns::Cells() const {
  std::vector<CellInput> cells;
  cells.reserve(size_);
  for (const Run& run : runs_) cells.insert(cells.end(), run.cells, run.input);
  return cells;
}

}  // namespace plumescout
