// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/distance_field.h"

#include <algorithm>
#include <vector>

#include "core/grid/padded.h"

namespace plumescout {
namespace {

constexpr std::int32_t kFar = kFarSquared;

// Distance to the nearest set cell of the same column, at most `limit`: one sweep north, one south.
Grid<std::int32_t> ColumnDistances(const Grid<std::uint8_t>& set, std::int32_t limit) {
  Grid<std::int32_t> distances(set.geometry(), limit);
  const int width = set.width();
  for (int y = 0; y < set.height(); ++y) {
    const std::uint8_t* source = GridRow(set, y);
    std::int32_t* row = GridRow(distances, y);
    const std::int32_t* south = y > 0 ? row - width : row;
    for (int x = 0; x < width; ++x) {
      row[x] = source[x] != 0 ? 0 : std::min(south[x] + 1, limit);
    }
  }
  for (int y = set.height() - 2; y >= 0; --y) {
    std::int32_t* row = GridRow(distances, y);
    const std::int32_t* north = row + width;
    for (int x = 0; x < width; ++x) row[x] = std::min(row[x], north[x] + 1);
  }
  return distances;
}

// Lower envelope along a row of the parabolas (x - u)^2 + g(u)^2, one for each column u whose
// distance g is known.
class Envelope {
 public:
  explicit Envelope(int width)
      : width_(width),
        vertex_(static_cast<std::size_t>(width)),
        begin_(static_cast<std::size_t>(width)) {}

  // `row`: column distances, `none` where a column has no set cell; replaced by the result.
  void Apply(std::int32_t* row, std::int32_t none) {
    count_ = 0;
    for (int u = 0; u < width_; ++u) {
      if (row[u] != none) Push({u, std::int64_t{row[u]} * row[u]});
    }
    if (count_ == 0) std::fill_n(row, width_, kFar);
    for (int x = width_; count_ > 0; --count_) {
      const Parabola& lowest = vertex_[count_ - 1];
      while (x > begin_[count_ - 1]) {
        --x;
        row[x] = static_cast<std::int32_t>(Value(lowest, x));
      }
    }
  }

 private:
  struct Parabola {
    int u = 0;
    std::int64_t base = 0;
  };

  static std::int64_t Value(const Parabola& p, std::int64_t x) {
    return (x - p.u) * (x - p.u) + p.base;
  }

  // First x at which `right` is lower than `left`. Not negative once Push has dropped all that
  // `right` undercuts where they begin.
  static std::int64_t Takeover(const Parabola& left, const Parabola& right) {
    const std::int64_t squares =
        std::int64_t{right.u} * right.u - std::int64_t{left.u} * left.u + right.base - left.base;
    return squares / (2 * (right.u - left.u)) + 1;
  }

  void Push(const Parabola& p) {
    while (count_ > 0 &&
           Value(vertex_[count_ - 1], begin_[count_ - 1]) > Value(p, begin_[count_ - 1])) {
      --count_;
    }
    const std::int64_t begin = count_ == 0 ? 0 : Takeover(vertex_[count_ - 1], p);
    if (begin >= width_) return;
    vertex_[count_] = p;
    begin_[count_] = static_cast<int>(begin);
    ++count_;
  }

  int width_;
  std::size_t count_ = 0;
  std::vector<Parabola> vertex_;
  std::vector<int> begin_;  // vertex_[i] is the lowest from begin_[i] on
};

}  // namespace

Grid<std::int32_t> SquaredDistances_cells2(const Grid<std::uint8_t>& set) {
  const std::int32_t none = set.height();  // larger than any distance within a column
  Grid<std::int32_t> distances = ColumnDistances(set, none);
  Envelope envelope(set.width());
  for (int y = 0; y < set.height(); ++y) envelope.Apply(GridRow(distances, y), none);
  return distances;
}

Grid<std::int32_t> SquaredDistancesUpTo_cells2(const Grid<std::uint8_t>& set, int cap_cells) {
  const std::int32_t cap_squared = cap_cells * cap_cells;
  Grid<std::int32_t> distances = ColumnDistances(set, cap_cells + 1);
  const int width = set.width();
  std::vector<std::int32_t> column_squared(static_cast<std::size_t>(width));
  for (int y = 0; y < set.height(); ++y) {
    std::int32_t* row = GridRow(distances, y);
    std::transform(row, row + width, column_squared.begin(), [](std::int32_t d) { return d * d; });
    std::copy(column_squared.begin(), column_squared.end(), row);
    for (int dx = 1; dx <= std::min(cap_cells, width - 1); ++dx) {
      const std::int32_t* column = column_squared.data();
      const std::int32_t across = dx * dx;
      for (int x = dx; x < width; ++x) row[x] = std::min(row[x], column[x - dx] + across);
      for (int x = 0; x < width - dx; ++x) row[x] = std::min(row[x], column[x + dx] + across);
    }
    for (int x = 0; x < width; ++x) row[x] = row[x] <= cap_squared ? row[x] : kFar;
  }
  return distances;
}

}  // namespace plumescout
