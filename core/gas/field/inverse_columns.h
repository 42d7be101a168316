// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/gas/field/field_factor.h"
#include "core/gas/field/separator_tree.h"
#include "core/types/stop.h"

namespace plumescout {

// Some columns of H^-1, or combinations of them. They are kept on the paths from certain cells to
// the root; elsewhere x_S = W x_R, node by node.
class InverseColumns {
 public:
  // H^-1 e_i for each i in `slots`; not to be used if `stop`, which is asked all along, says so.
  // REQUIRES: slots are active, one at least; `factor` outlives this. Cost: that of the paths.
  InverseColumns(const FieldFactor& factor, std::span<const Slot> slots, const StopFn& stop = {});

  // REQUIRES: `slot` is one of those.
  double At(Slot slot, std::size_t column) const;

  // Each row x (one element of each column) becomes M x. `matrix` is square, by columns that lie
  // `stride` >= PaddedRows(columns) apart and are 0 beyond its rows.
  void Mix(const double* matrix, std::size_t stride);

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
  // Cost: all weights of the nodes that are visited.
  void Descend(Visitor& visitor);

  // by_cell[cell] -= |x|^2 for the row x of each active cell, but for subtrees off the paths on
  // whose boundary that is at most `limit`: with W >= 0 and row sums of at most 1, no row inside is
  // longer than the longest there. The rest is left out once `stop`, which is asked all along, says
  // so. Cost: all weights of the others.
  void SubtractSquares(double limit, std::vector<double>& by_cell, const StopFn& stop = {});

 private:
  // Of the cells of one front, own ones first.
  struct Block {
    std::vector<double> rows;
    std::vector<double> squares;  // by row
  };

  static constexpr std::size_t kOffPaths = ~std::size_t{0};

  void PlacePaths(std::span<const Slot> slots, const StopFn& stop);
  // Where the rows of the own cells of a node begin in path_rows_; kOffPaths if it has none there.
  std::size_t FirstOf(std::size_t node) const;
  void CompletePath(std::size_t node, std::size_t depth, const StopFn& stop);
  void DescendBelow(std::size_t node, std::size_t depth, Visitor& visitor);
  void GatherBoundary(std::size_t node, std::size_t depth);
  void Continue(const Front& front, Block& block);

  const FieldFactor* factor_;
  std::size_t columns_;
  std::size_t stride_;                     // of rows; 0 beyond the columns
  std::vector<std::uint32_t> path_nodes_;  // ascending
  std::vector<std::size_t> first_;         // FirstOf each
  std::vector<double> path_rows_;

  std::vector<Block> blocks_;  // by depth
  std::vector<std::uint32_t> place_;
  std::vector<double> weights_;
};

}  // namespace plumescout
