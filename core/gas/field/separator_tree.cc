// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/separator_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

}  // namespace

// Builds the tree, children first.
class Dissection {
 public:
  Dissection(SeparatorTree& tree, std::size_t height, std::span<const std::uint8_t> active,
             const StopFn& stop)
      : tree_(tree), active_(active), stop_(stop) {
    places_.reserve(active.size());
    const auto width = static_cast<std::int32_t>(tree.width());
    for (std::int32_t y = 0; y < static_cast<std::int32_t>(height); ++y) {
      for (std::int32_t x = 0; x < width; ++x) places_.push_back({x, y});
    }
    AddLines(0.0, height);
    const double slope = WallSlope(tree.width(), height, active);
    if (slope != 0.0) AddLines(slope, height);
  }

  void Run() { Split(places_); }

 private:
  using Places = std::span<LatticeCell>;

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

  void AddLines(double slope, std::size_t height) {
    lines_.emplace_back(LatticeLines::Across::kX, slope, tree_.width(), height);
    lines_.emplace_back(LatticeLines::Across::kY, slope, tree_.width(), height);
  }

  std::uint32_t Cell(LatticeCell place) const {
    return static_cast<std::uint32_t>(place.y) * static_cast<std::uint32_t>(tree_.width()) +
           static_cast<std::uint32_t>(place.x);
  }

  std::uint32_t Split(Places part) {
    if (part.size() <= kLeafCells || Stops(stop_)) {
      return AddNode(part, {SeparatorTree::kNone, SeparatorTree::kNone});
    }
    const Line line = BestLine(part);
    const auto side = [&line](LatticeCell place) { return line.lines->line(place) - line.number; };
    const auto high = std::stable_partition(part.begin(), part.end(),
                                            [&](LatticeCell place) { return side(place) < 0; });
    const auto own =
        std::stable_partition(high, part.end(), [&](LatticeCell place) { return side(place) > 0; });
    const std::uint32_t low_node = Split({part.begin(), high});
    const std::uint32_t high_node = Split({high, own});
    const std::uint32_t node = AddNode({own, part.end()}, {low_node, high_node});
    tree_.nodes_[low_node].parent = node;
    tree_.nodes_[high_node].parent = node;
    return node;
  }

  // The best line with cells on both sides. REQUIRES: a part of more cells than a leaf, so that
  // columns or rows number at least three.
  Line BestLine(Places part) {
    Line best;
    for (const LatticeLines& lines : lines_) {
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
  std::pair<std::size_t, std::size_t> CountLines(const LatticeLines& lines, Places part) {
    counts_.resize(std::max(counts_.size(), lines.count()));
    std::size_t first = lines.count();
    std::size_t last = 0;
    for (const LatticeCell place : part) {
      const auto line = static_cast<std::size_t>(lines.line(place));
      first = std::min(first, line);
      last = std::max(last, line);
      ++counts_[line].cells;
      counts_[line].active += active_[Cell(place)];
    }
    return {first, last};
  }

  std::uint32_t AddNode(Places own, const std::array<std::uint32_t, 2>& children) {
    const auto id = static_cast<std::uint32_t>(tree_.nodes_.size());
    const auto first = static_cast<Slot>(tree_.cell_of_slot_.size());
    for (const LatticeCell place : own) {
      const std::uint32_t cell = Cell(place);
      tree_.slot_of_cell_[cell] = static_cast<Slot>(tree_.cell_of_slot_.size());
      tree_.cell_of_slot_.push_back(cell);
      tree_.owner_.push_back(id);
    }
    const auto end = static_cast<Slot>(tree_.cell_of_slot_.size());
    tree_.nodes_.push_back({SeparatorTree::kNone, children, first, end});
    return id;
  }

  SeparatorTree& tree_;
  std::span<const std::uint8_t> active_;
  const StopFn& stop_;
  std::vector<LatticeCell> places_;  // those of a part side by side
  std::vector<LatticeLines> lines_;
  std::vector<Count> counts_;  // by line; 0 between uses
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
