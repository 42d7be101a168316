// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/gas/field/cell_input.h"

namespace plumescout {

// What a field was told of its cells, kept for long: runs of cells that were told the same, to the
// bit. Of a map with walls and readings that is a fiftieth of the cells themselves.
class CellRuns {
 public:
  CellRuns() = default;
  explicit CellRuns(std::span<const CellInput> cells);

  std::size_t size() const { return size_; }  // in cells
  std::vector<CellInput> Cells() const;

 private:
  struct Run {
    std::uint32_t cells = 0;
    CellInput input;
  };
  std::size_t size_ = 0;
  std::vector<Run> runs_;
};

}  // namespace plumescout
