// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/window_sums.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid/padded.h"

namespace plumescout {
namespace {

// Row y, column x: the sum over all cells west of x and south of y (Crow 1984). Keeps the rows that
// windows of this reach need at once.
class SumTable {
 public:
  SumTable(const Grid<float>& values, int reach_cells)
      : values_(values),
        width_(static_cast<std::size_t>(values.width()) + 1),
        kept_(std::min(2 * static_cast<std::int64_t>(reach_cells) + 2,
                       static_cast<std::int64_t>(values.height()) + 1)),
        rows_(width_ * static_cast<std::size_t>(kept_), 0.0) {}

  // REQUIRES: `y` is none of those that were given up for later rows.
  const double* Row(int y) {
    for (; last_ < y; ++last_) AddRow();
    return RowOf(y);
  }

 private:
  double* RowOf(int y) { return rows_.data() + width_ * static_cast<std::size_t>(y % kept_); }

  void AddRow() {
    const float* const values = GridRow(values_, last_);
    const double* const south = RowOf(last_);
    double* const sums = RowOf(last_ + 1);
    double row = 0.0;
    sums[0] = 0.0;
    for (std::size_t x = 0; x + 1 < width_; ++x) {
      row += static_cast<double>(values[x]);
      sums[x + 1] = south[x + 1] + row;
    }
  }

  const Grid<float>& values_;
  std::size_t width_;
  std::int64_t kept_;
  std::vector<double> rows_;
  int last_ = 0;  // row that is known
};

}  // namespace

Grid<float> WindowSums(const Grid<float>& values, int reach_cells, const StopFn& stop) {
  const int width = values.width();
  const int height = values.height();
  Grid<float> sums(values.geometry(), 0.0F, stop);
  SumTable table(values, reach_cells);
  ByRows(0, height, width, stop, [&](int y) {
    // The northern one first: then both are there.
    const double* const north = table.Row(std::min(height, y + reach_cells + 1));
    const double* const south = table.Row(std::max(0, y - reach_cells));
    float* const row = GridRow(sums, y);
    const auto sum = [&](int west, int east) {
      return static_cast<float>(north[east] - north[west] - south[east] + south[west]);
    };
    const int inside_begin = std::min(width, reach_cells);
    const int inside_end = std::max(inside_begin, width - reach_cells);
    for (int x = 0; x < inside_begin; ++x) row[x] = sum(0, std::min(width, x + reach_cells + 1));
    for (int x = inside_begin; x < inside_end; ++x) {
      row[x] = sum(x - reach_cells, x + reach_cells + 1);
    }
    for (int x = inside_end; x < width; ++x) row[x] = sum(std::max(0, x - reach_cells), width);
  });
  return sums;
}

}  // namespace plumescout
