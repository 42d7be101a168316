// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/gas/field/field_cells.h"
#include "core/gas/field/separator_tree.h"
#include "core/linalg/dense_kernel.h"

namespace plumescout {

// lambda_p and lambda_d of [IPP] Eq. (1).
struct FieldPrior {
  double prior_precision = 0.0;       // > 0
  double background_precision = 0.0;  // > 0
};

// One node of a separator tree, eliminated: given the deviations m_R of its boundary, those of its
// own active cells S are Gaussian with
//   mean      m_S = offset + W m_R
//   covariance      C
// and what the subtree says of m_R is `message`. The boundary R are the active cells of ancestors
// that the subtree touches. W >= 0 with row sums <= 1, and C >= 0 element by element, since H is an
// M-matrix. With H = L L^T, X = L_SS^-1: C = X^T X, W = -X^T L_RS^T. Immutable once built.
struct Front {
  std::vector<Slot> cells;         // ascending: S, then R
  std::size_t own = 0;             // |S|
  std::size_t stride = 0;          // of C and W, >= |S|, in whole row tiles; padding is 0
  std::vector<double> covariance;  // C: S x S
  std::vector<double> weights;     // W: S x R
  std::vector<double> offset_ppm;  // S
  // The Schur complement on R as DominantFront keeps it, columns packed: below the diagonal, then
  // ground, then right-hand side. Absent after a reading.
  std::vector<double> message;

  std::size_t boundary() const { return cells.size() - own; }
  // Multiply-adds of the elimination.
  double work() const;

  // own += W boundary; `own` has `stride` elements.
  void AddWeighted(std::span<const double> boundary, double* own) const;
  std::span<const Slot> own_cells() const { return {cells.data(), own}; }
  std::span<const Slot> boundary_cells() const { return {cells.data() + own, boundary()}; }
};

// Padded rows of a column-major block that a product reads or writes from its first row on.
constexpr std::size_t TileRows(std::size_t rows) {
  return (rows + kRowTile - 1) / kRowTile * kRowTile;
}

// A reading of cell i in the subtree of a node, as the node sees it. Moments are those given that
// its boundary is 0.
struct PathStep {
  std::uint32_t node = 0;
  std::vector<double> own;       // p: covariance of cell i with the own cells
  std::vector<double> boundary;  // q: weights of the boundary in the mean of cell i
  double mean_ppm = 0.0;         // of cell i
  double variance_ppm2 = 0.0;
};

// The front once cell i has `precision` more on the diagonal and `weighted_deviation` more on the
// right-hand side: all but the message, which needs an elimination. Cost: a copy.
std::shared_ptr<const Front> AfterReading(const Front& front, const PathStep& step,
                                          double precision, double weighted_deviation);

// y += a x, for a column-major `a` whose columns are whole row tiles.
void AddProduct(const double* a, std::size_t stride, std::span<const double> x, double* y);

// Places of the ascending slots `some` among the ascending slots `all`, which hold them.
void FindPlaces(std::span<const Slot> some, std::span<const Slot> all,
                std::vector<std::uint32_t>& places);

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
  void KeepMessage(Front& front) const;

  const SeparatorTree* tree_;
  FieldPrior prior_;
  std::vector<std::uint32_t> place_;  // by slot: row in the front
  std::vector<double> matrix_;        // the front, rows: S, R, ground, right-hand side
  std::size_t rows_ = 0;
  std::size_t matrix_stride_ = 0;
  std::vector<double> inverse_;             // X
  std::vector<double> transposed_inverse_;  // X^T
  std::vector<double> extended_weights_;    // W, and its columns for ground and right-hand side
};

}  // namespace plumescout
