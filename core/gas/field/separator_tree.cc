// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/separator_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

struct Rectangle {
  std::size_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // [x0, x1) x [y0, y1)

  std::size_t area() const { return (x1 - x0) * (y1 - y0); }
};

// Number of active cells in any rectangle, in O(1).
class ActiveCount {
 public:
  ActiveCount(std::size_t width, std::size_t height, std::span<const std::uint8_t> active)
      : stride_(width + 1), sums_(stride_ * (height + 1), 0) {
    for (std::size_t y = 0; y < height; ++y) {
      std::uint32_t row = 0;
      for (std::size_t x = 0; x < width; ++x) {
        row += active[y * width + x] != 0 ? 1 : 0;
        sums_[(y + 1) * stride_ + x + 1] = sums_[y * stride_ + x + 1] + row;
      }
    }
  }
  std::uint32_t operator()(const Rectangle& r) const {
    return At(r.x1, r.y1) + At(r.x0, r.y0) - At(r.x0, r.y1) - At(r.x1, r.y0);
  }
  double Weight(const Rectangle& r) const {
    const double active = (*this)(r);
    return active + kInactiveWeight * (static_cast<double>(r.area()) - active);
  }

 private:
  std::uint32_t At(std::size_t x, std::size_t y) const { return sums_[y * stride_ + x]; }

  std::size_t stride_;
  std::vector<std::uint32_t> sums_;
};

struct Cut {
  Rectangle low, line, high;
  double score = std::numeric_limits<double>::infinity();
};

Cut CutAt(const Rectangle& r, bool vertical, std::size_t at) {
  Cut cut{r, r, r};
  if (vertical) {
    cut.low.x1 = cut.line.x0 = at;
    cut.line.x1 = cut.high.x0 = at + 1;
  } else {
    cut.low.y1 = cut.line.y0 = at;
    cut.line.y1 = cut.high.y0 = at + 1;
  }
  return cut;
}

double Score(const Cut& cut, const ActiveCount& count) {
  const double low = count.Weight(cut.low);
  const double high = count.Weight(cut.high);
  const double imbalance = std::abs(low - high) / (low + high);
  if (imbalance > kMaxImbalance) return std::numeric_limits<double>::max() * imbalance;
  const double length = count(cut.line) + kLineCharge * static_cast<double>(cut.line.area());
  return length * (1.0 + kImbalancePenalty * imbalance * imbalance);
}

// The best line with cells on both sides. REQUIRES: a side of at least three cells.
Cut BestCut(const Rectangle& r, const ActiveCount& count) {
  Cut best;
  for (const bool vertical : {true, false}) {
    const std::size_t begin = vertical ? r.x0 : r.y0;
    const std::size_t end = vertical ? r.x1 : r.y1;
    for (std::size_t at = begin + 1; at + 1 < end; ++at) {
      Cut cut = CutAt(r, vertical, at);
      cut.score = Score(cut, count);
      if (cut.score < best.score) best = cut;
    }
  }
  return best;
}

}  // namespace

// Builds the tree, children first.
class Dissection {
 public:
  Dissection(SeparatorTree& tree, const ActiveCount& count) : tree_(tree), count_(count) {}

  std::uint32_t Split(const Rectangle& r) {
    if (r.area() <= kLeafCells) return AddNode(r, {SeparatorTree::kNone, SeparatorTree::kNone});
    const Cut cut = BestCut(r, count_);
    const std::uint32_t low = Split(cut.low);
    const std::uint32_t high = Split(cut.high);
    const std::uint32_t node = AddNode(cut.line, {low, high});
    tree_.nodes_[low].parent = node;
    tree_.nodes_[high].parent = node;
    return node;
  }

 private:
  std::uint32_t AddNode(const Rectangle& own, const std::array<std::uint32_t, 2>& children) {
    const auto id = static_cast<std::uint32_t>(tree_.nodes_.size());
    const auto first = static_cast<Slot>(tree_.cell_of_slot_.size());
    for (std::size_t y = own.y0; y < own.y1; ++y) {
      for (std::size_t x = own.x0; x < own.x1; ++x) {
        const std::size_t cell = y * tree_.width_ + x;
        tree_.slot_of_cell_[cell] = static_cast<Slot>(tree_.cell_of_slot_.size());
        tree_.cell_of_slot_.push_back(static_cast<std::uint32_t>(cell));
        tree_.owner_.push_back(id);
      }
    }
    const auto end = static_cast<Slot>(tree_.cell_of_slot_.size());
    tree_.nodes_.push_back({SeparatorTree::kNone, children, first, end});
    return id;
  }

  SeparatorTree& tree_;
  const ActiveCount& count_;
};

SeparatorTree::SeparatorTree(std::size_t width, std::size_t height,
                             std::span<const std::uint8_t> active)
    : width_(width), slot_of_cell_(width * height) {
  cell_of_slot_.reserve(cells());
  owner_.reserve(cells());
  Dissection(*this, ActiveCount(width, height, active)).Split({0, 0, width, height});
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
