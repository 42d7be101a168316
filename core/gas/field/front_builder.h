// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/gas/field/field_cells.h"
#include "core/gas/field/front.h"
#include "core/gas/field/separator_tree.h"

namespace plumescout {

// lambda_p and lambda_d of [IPP] Eq. (1).
struct FieldPrior {
  double prior_precision_per_ppm2 = 0.0;       // > 0
  double background_precision_per_ppm2 = 0.0;  // > 0
};

// Builds fronts; holds scratch memory only.
class FrontBuilder {
 public:
  FrontBuilder(const SeparatorTree& tree, const FieldPrior& prior)
      : tree_(&tree), prior_(prior), place_(tree.cells(), 0) {}

  // `children` are those of the node, or null for a leaf.
  std::shared_ptr<const Front> Build(const SeparatorTree::Node& node, const FieldCells& cells,
                                     const Front* low, const Front* high);

 private:
  void FindCells(const SeparatorTree::Node& node, const FieldCells& cells, const Front* low,
                 const Front* high, Front& front);
  void Assemble(const FieldCells& cells, const Front& front);
  void AddMessage(const Front& child);
  void Condition(Front& front);
  void KeepDistribution(std::size_t weight_columns, Front& front) const;
  void Couple(const FieldCells& cells, Front& front);
  void KeepMessage(Front& front) const;

  const SeparatorTree* tree_;
  FieldPrior prior_;
  std::vector<std::uint32_t> place_;  // by slot: row in the front
  // A front's own are made of these at once, for growing ones ask for memory again and again.
  std::vector<Slot> found_;
  std::vector<Front::Coupling> couplings_;
  std::vector<std::uint8_t> is_coupled_;  // by cell of the boundary
  std::vector<double> matrix_;            // the front, rows: S, R, ground, right-hand side
  std::size_t rows_ = 0;
  std::size_t matrix_stride_ = 0;
  std::vector<double> transposed_inverse_;  // X^T
  std::vector<double> covariance_;          // C
  std::vector<double> extended_weights_;    // W, and its columns for ground and right-hand side
};

}  // namespace plumescout
