// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_what_if.h"

#include <cstddef>
#include <limits>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout {

absl::StatusOr<Grid<float>> GasWhatIf::VarianceIfRead(std::span<const Cell> cells,
                                                      double precision) const {
  const Grid<CellState>& states = states_.states();
  std::vector<std::size_t> read;
  for (const Cell cell : cells) {
    if (!states.Contains(cell)) {
      return absl::InvalidArgumentError(
          absl::StrCat("cell (", cell.x, ", ", cell.y, ") lies off the map"));
    }
    const std::size_t index = geometry().Index(cell);
    if (states[index] == CellState::kFree) read.push_back(FieldIndex(index));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<double> variance_ppm2,
                              field_.VarianceIfRead(read, precision));
  Grid<float> result(geometry(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (states[i] == CellState::kFree) {
      result[i] = static_cast<float>(variance_ppm2[FieldIndex(i)]);
    }
  }
  return result;
}

}  // namespace plumescout
