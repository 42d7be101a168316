// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/gas/field/field_factor.h"
#include "core/gas/field/reading_paths.h"
#include "core/linalg/room.h"
#include "core/types/stop.h"

namespace plumescout {

// Some columns of H^-1, or combinations of them, from the root down: x_S = W x_R, node by node, and
// what the cells that they are of add in the nodes on their paths.
class InverseColumns {
 public:
  // H^-1 e_i for each i of `paths`. Takes the memory of those that are `used` no more. REQUIRES:
  // `paths` are of `factor`, which outlives this.
  InverseColumns(const FieldFactor& factor, ReadingPaths paths,
                 std::optional<InverseColumns> used = std::nullopt);

  const ReadingPaths& paths() const { return paths_; }
  ReadingPaths TakePaths() && { return std::move(paths_); }

  // Each row x (one element of each column) becomes M x. `matrix` is square and lower triangular,
  // by columns that lie `stride` >= PaddedRows(columns) apart and are 0 beyond its rows. REQUIRES:
  // not called before.
  void Mix(std::vector<double> matrix, std::size_t stride);

  // Told of |x|^2 for the rows x, from the root down.
  class Visitor {
   public:
    virtual ~Visitor() = default;
    // Whether to go on into a node off the paths, by the squares on its boundary, which is not
    // empty.
    virtual bool Enter(std::size_t node, std::span<const double> squares) = 0;
    // Those of the own cells of a node on a path, or that was entered.
    virtual void Take(std::span<const Slot> own, std::span<const double> squares) = 0;
  };
  // Squares off the paths may be too small by `slack`. Cost: all weights of the nodes that are
  // visited.
  void Descend(Visitor& visitor, double slack = 0.0);

  // by_slot[slot] -= |x|^2 for the row x of each active cell, but for subtrees off the paths on
  // whose boundary that is at most `limit`, and for as much in all others: with W >= 0 and row sums
  // of at most 1, no row inside is longer than the longest there. The rest is left out once `stop`,
  // which is asked all along, says so. Cost: all weights of the others.
  void SubtractSquares(double limit, std::vector<double>& by_slot, const StopFn& stop = {});

 private:
  // Of the cells of one front, own ones first.
  struct Block {
    Room rows;
    Room squares;            // by row
    std::size_t stride = 0;  // of rows, 0 beyond the columns
    double slack = 0.0;      // by which squares below may still be too small
  };

  void DescendBelow(std::size_t node, std::size_t depth, bool on_path, Visitor& visitor);
  // Of the boundary, out of the block of the parent.
  void GatherSquares(const Front& front, std::size_t node, std::size_t depth);
  void GatherRows(const Front& front, std::size_t depth);
  void Compress(const Front& front, Block& block);
  void Continue(const Front& front, Block& block);
  void AddOwn(const ReadingPaths::Step& step, const Front& front, Block& block) const;

  const FieldFactor* factor_;
  ReadingPaths paths_;
  std::size_t stride_;  // of rows on the paths
  double slack_ = 0.0;  // there
  std::vector<double> mix_;
  std::size_t mix_stride_ = 0;

  std::vector<Block> blocks_;             // by depth
  std::span<const std::uint32_t> place_;  // of the present boundary, in the block of the parent
  std::vector<double> weights_;

  // Of Compress.
  std::vector<double> left_;   // of the squares
  std::vector<double> lower_;  // L by rows
};

}  // namespace plumescout
