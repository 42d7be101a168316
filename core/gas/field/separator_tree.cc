// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/separator_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/gas/field/lattice_lines.h"

namespace plumescout {
namespace {

// Cells of a leaf at most. Smaller ones cost overhead per node, larger ones dense arithmetic.
constexpr std::size_t kLeafCells = 48;

// A cell that is not active yet weighs this much when halves are balanced: it may become so.
constexpr double kInactiveWeight = 0.05;

// By how much one part may outweigh the other, as share of both, and how dear that is beside the
// length of the cut: chosen by the time of fresh computations on open and indoor maps.
constexpr double kMaxImbalance = 0.6;
constexpr double kImbalancePenalty = 2.0;
// Active cells that every line is charged besides its own, per cell of length: among lines through
// walls the one in the middle wins.
constexpr double kLineCharge = 0.1;

// Weights of the parts that a line divides, and that of the line.
double Score(double low, double high, double line) {
  const double imbalance = std::abs(low - high) / (low + high);
  if (imbalance > kMaxImbalance) return std::numeric_limits<double>::max() * imbalance;
  return line * (1.0 + kImbalancePenalty * imbalance * imbalance);
}

// How many cells of a row, and of a column, are active up to any of its cells.
class ActiveSums {
 public:
  ActiveSums(std::size_t width, std::size_t height, std::span<const std::uint8_t> active)
      : width_(width), rows_((width + 1) * height), columns_(width * (height + 1)) {
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        const std::uint32_t here = active[y * width + x];
        rows_[RowPlace(x + 1, y)] = rows_[RowPlace(x, y)] + here;
        columns_[(y + 1) * width + x] = columns_[y * width + x] + here;
      }
    }
  }
  std::uint32_t InRow(std::size_t y, std::size_t x_begin, std::size_t x_end) const {
    return rows_[RowPlace(x_end, y)] - rows_[RowPlace(x_begin, y)];
  }
  std::uint32_t InColumn(std::size_t x, std::size_t y_begin, std::size_t y_end) const {
    return columns_[y_end * width_ + x] - columns_[y_begin * width_ + x];
  }

 private:
  std::size_t RowPlace(std::size_t x, std::size_t y) const { return y * (width_ + 1) + x; }

  std::size_t width_;
  std::vector<std::uint32_t> rows_;
  std::vector<std::uint32_t> columns_;
};

}  // namespace

// Builds the tree, children first.
class Dissection {
 public:
  Dissection(SeparatorTree& tree, std::size_t height, std::span<const std::uint8_t> active,
             const StopFn& stop)
      : tree_(tree), height_(height), active_(active), stop_(stop) {
    AddLines(0.0);
  }

  void Run() {
    const double slope = WallSlope(tree_.width(), height_, active_);
    if (slope == 0.0) {
      sums_.emplace(tree_.width(), height_, active_);
      Split(Box{0, tree_.width(), 0, height_});
    } else {
      AddLines(slope);
      std::vector<LatticeCell> places;
      places.reserve(active_.size());
      ForEachCell(Box{0, tree_.width(), 0, height_}, [&places](std::size_t x, std::size_t y) {
        places.push_back({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)});
      });
      Split(Places{places});
    }
  }

 private:
  // Parts of the lattice: as lines along the axes leave them, cells [x_begin, x_end) of rows
  // [y_begin, y_end); and as any lines do, cells side by side, row by row.
  struct Box {
    std::size_t x_begin = 0;
    std::size_t x_end = 0;
    std::size_t y_begin = 0;
    std::size_t y_end = 0;

    std::size_t size() const { return (x_end - x_begin) * (y_end - y_begin); }
  };
  using Places = std::span<LatticeCell>;
  template <typename Part>
  struct Parts {
    Part low;
    Part high;
    Part own;  // on the line
  };

  struct Line {
    const LatticeLines* lines = nullptr;
    std::int32_t number = 0;
    double score = std::numeric_limits<double>::infinity();
  };
  // Cells of a part that lie on one line.
  struct Count {
    std::uint32_t cells = 0;
    std::uint32_t active = 0;

    double weight() const { return active + kInactiveWeight * (cells - active); }
    double length() const { return active + kLineCharge * cells; }
  };

  void AddLines(double slope) {
    lines_.emplace_back(LatticeLines::Across::kX, slope, tree_.width(), height_);
    lines_.emplace_back(LatticeLines::Across::kY, slope, tree_.width(), height_);
  }

  std::uint32_t Cell(std::size_t x, std::size_t y) const {
    return static_cast<std::uint32_t>(y * tree_.width() + x);
  }

  template <typename Visit>
  static void ForEachCell(const Box& box, const Visit& visit) {
    for (std::size_t y = box.y_begin; y < box.y_end; ++y) {
      for (std::size_t x = box.x_begin; x < box.x_end; ++x) visit(x, y);
    }
  }
  template <typename Visit>
  static void ForEachCell(Places places, const Visit& visit) {
    for (const LatticeCell place : places) {
      visit(static_cast<std::size_t>(place.x), static_cast<std::size_t>(place.y));
    }
  }

  template <typename Part>
  std::uint32_t Split(Part part) {
    if (part.size() <= kLeafCells || Stops(stop_)) {
      return AddNode(part, {SeparatorTree::kNone, SeparatorTree::kNone});
    }
    const Parts<Part> parts = Divide(part, BestLine(part));
    const std::uint32_t low_node = Split(parts.low);
    const std::uint32_t high_node = Split(parts.high);
    const std::uint32_t node = AddNode(parts.own, {low_node, high_node});
    tree_.nodes_[low_node].parent = node;
    tree_.nodes_[high_node].parent = node;
    return node;
  }

  static Parts<Box> Divide(const Box& box, const Line& line) {
    Parts<Box> parts = {box, box, box};
    const auto at = static_cast<std::size_t>(line.number);
    if (line.lines->across() == LatticeLines::Across::kX) {
      parts.low.x_end = parts.own.x_begin = at;
      parts.own.x_end = parts.high.x_begin = at + 1;
    } else {
      parts.low.y_end = parts.own.y_begin = at;
      parts.own.y_end = parts.high.y_begin = at + 1;
    }
    return parts;
  }
  static Parts<Places> Divide(Places part, const Line& line) {
    const auto side = [&line](LatticeCell place) { return line.lines->line(place) - line.number; };
    const auto high = std::stable_partition(part.begin(), part.end(),
                                            [&](LatticeCell place) { return side(place) < 0; });
    const auto own =
        std::stable_partition(high, part.end(), [&](LatticeCell place) { return side(place) > 0; });
    return {{part.begin(), high}, {high, own}, {own, part.end()}};
  }

  // The best line with cells on both sides. REQUIRES: a part of more cells than a leaf, so that
  // columns or rows number at least three.
  template <typename Part>
  Line BestLine(const Part& part) {
    Line best;
    for (const LatticeLines& lines : lines_) {
      counts_.resize(std::max(counts_.size(), lines.count()));
      const auto [first, last] = CountLines(lines, part);
      double above = 0.0;
      for (std::size_t k = first; k <= last; ++k) above += counts_[k].weight();
      double below = 0.0;
      for (std::size_t k = first; k <= last; ++k) {
        const Count count = std::exchange(counts_[k], {});
        above -= count.weight();
        if (k > first && k < last) {
          const double score = Score(below, above, count.length());
          if (score < best.score) best = {&lines, static_cast<std::int32_t>(k), score};
        }
        below += count.weight();
      }
    }
    return best;
  }

  // Adds the part to counts_; returns its first and its last line.
  std::pair<std::size_t, std::size_t> CountLines(const LatticeLines& lines, const Box& box) {
    if (lines.across() == LatticeLines::Across::kX) {
      const auto cells = static_cast<std::uint32_t>(box.y_end - box.y_begin);
      for (std::size_t x = box.x_begin; x < box.x_end; ++x) {
        counts_[x] = {cells, sums_->InColumn(x, box.y_begin, box.y_end)};
      }
      return {box.x_begin, box.x_end - 1};
    }
    const auto cells = static_cast<std::uint32_t>(box.x_end - box.x_begin);
    for (std::size_t y = box.y_begin; y < box.y_end; ++y) {
      counts_[y] = {cells, sums_->InRow(y, box.x_begin, box.x_end)};
    }
    return {box.y_begin, box.y_end - 1};
  }
  std::pair<std::size_t, std::size_t> CountLines(const LatticeLines& lines, Places part) {
    std::size_t first = lines.count();
    std::size_t last = 0;
    for (const LatticeCell place : part) {
      const auto line = static_cast<std::size_t>(lines.line(place));
      first = std::min(first, line);
      last = std::max(last, line);
      ++counts_[line].cells;
      counts_[line].active +=
          active_[Cell(static_cast<std::size_t>(place.x), static_cast<std::size_t>(place.y))];
    }
    return {first, last};
  }

  template <typename Part>
  std::uint32_t AddNode(const Part& own, const std::array<std::uint32_t, 2>& children) {
    const auto id = static_cast<std::uint32_t>(tree_.nodes_.size());
    const auto first = static_cast<Slot>(tree_.cell_of_slot_.size());
    ForEachCell(own, [&](std::size_t x, std::size_t y) {
      const std::uint32_t cell = Cell(x, y);
      tree_.slot_of_cell_[cell] = static_cast<Slot>(tree_.cell_of_slot_.size());
      tree_.cell_of_slot_.push_back(cell);
      tree_.owner_.push_back(id);
    });
    const auto end = static_cast<Slot>(tree_.cell_of_slot_.size());
    tree_.nodes_.push_back({SeparatorTree::kNone, children, first, end});
    return id;
  }

  SeparatorTree& tree_;
  std::size_t height_;
  std::span<const std::uint8_t> active_;
  const StopFn& stop_;
  std::vector<LatticeLines> lines_;
  std::optional<ActiveSums> sums_;  // of boxes
  std::vector<Count> counts_;       // by line; 0 between uses
};

SeparatorTree::SeparatorTree(std::size_t width, std::size_t height,
                             std::span<const std::uint8_t> active, const StopFn& stop)
    : width_(width), slot_of_cell_(width * height) {
  cell_of_slot_.reserve(cells());
  owner_.reserve(cells());
  Dissection(*this, height, active, stop).Run();
  FindNeighbours();
}

void SeparatorTree::FindNeighbours() {
  const std::size_t height = cells() / width_;
  neighbours_.assign(cells(), {kNoSlot, kNoSlot, kNoSlot, kNoSlot});
  for (std::size_t i = 0; i < cells(); ++i) {
    std::array<Slot, 4>& n = neighbours_[slot_of_cell_[i]];
    if (i % width_ + 1 < width_) n[0] = slot_of_cell_[i + 1];
    if (i / width_ + 1 < height) n[1] = slot_of_cell_[i + width_];
    if (i % width_ > 0) n[2] = slot_of_cell_[i - 1];
    if (i / width_ > 0) n[3] = slot_of_cell_[i - width_];
  }
}

}  // namespace plumescout
