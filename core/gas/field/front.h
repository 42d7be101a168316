// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/gas/field/separator_tree.h"
#include "core/linalg/dense_kernel.h"

namespace plumescout {

// Padded rows of a column-major block that a product reads or writes from its first row on.
constexpr std::size_t TileRows(std::size_t rows) {
  return (rows + kRowTile - 1) / kRowTile * kRowTile;
}

// One node of a separator tree, eliminated: given the deviations m_R of its boundary, those of its
// own active cells S are Gaussian with
//   mean      m_S = offset + W m_R
//   covariance      C
// and what the subtree says of m_R is `message`. The boundary R are the active cells of ancestors
// that the subtree touches. W >= 0 with row sums <= 1, and C >= 0 element by element, since H is an
// M-matrix. With H = L L^T, X = L_SS^-1: C = X^T X, W = -X^T L_RS^T. Immutable once built.
struct Front {
  // A prior factor between a cell of S and one of R of a leaf, which has few of both. Small, for
  // there are nearly as many as cells.
  static constexpr std::size_t kMaxLeafBoundary = std::size_t{1} << 15;
  struct Coupling {
    std::uint16_t own = 0;
    std::uint16_t boundary : 15 = 0;
    bool is_first : 1 = true;  // of those of this cell of R, each of which has one
  };

  std::vector<Slot> cells;         // ascending: S, then R
  std::size_t own = 0;             // |S|
  std::vector<double> covariance;  // C: lower triangle, packed by columns
  // W by columns, and elements that a tile may read beyond. A leaf has none: it touches its
  // boundary by its own factors only, so that W = lambda_p C K with K_sr = 1 for couplings (s, r).
  std::vector<double> weights;
  std::vector<Coupling> couplings;
  double coupling_precision = 0.0;  // lambda_p
  std::vector<double> offset_ppm;   // S
  std::vector<double> weight_sums;  // W 1
  // Which of `cells` the boundary cells of the first child are, then those of the second.
  std::vector<std::uint32_t> child_places;
  // The Schur complement on R as DominantFront keeps it, columns packed: below the diagonal, then
  // ground, then right-hand side. Absent after a reading.
  std::vector<double> message;

  std::size_t boundary() const { return cells.size() - own; }
  std::span<const Slot> own_cells() const { return {cells.data(), own}; }
  std::span<const Slot> boundary_cells() const { return {cells.data() + own, boundary()}; }
  // Column j of C, from the diagonal down.
  const double* covariance_column(std::size_t j) const {
    return covariance.data() + j * own - (j * j - j) / 2;
  }

  // result += C own
  void AddCovariance(std::span<const double> own_values, double* result) const;
  // result += W boundary; `scratch` is for |S| elements.
  void AddWeighted(std::span<const double> boundary_values, std::vector<double>& scratch,
                   double* result) const;
  // result += W^T own; `scratch` is for |S| elements. Sums are rounded in another order than those
  // of AddCovariance.
  void AddTransposed(std::span<const double> own_values, std::vector<double>& scratch,
                     double* result) const;
  // Makes weight_sums of W.
  void SumWeights();
  // W, |S| rows: a tile may read beyond its end. `scratch` may hold it, and must then live on.
  const double* Weights(std::vector<double>& scratch) const;

  // Asks memory for what will be read of the front soon: its arrays lie apart, and to wait for each
  // in turn costs more than to use them.
  void Prefetch() const;

  // Multiply-adds of the elimination.
  double work() const;
};

// A reading of cell i in the subtree of a node, as the node sees it. Moments are those given that
// its boundary is 0.
struct PathStep {
  std::uint32_t node = 0;
  std::vector<double> own;       // p: covariance of cell i with the own cells
  std::vector<double> boundary;  // q: weights of the boundary in the mean of cell i
  double mean_ppm = 0.0;         // of cell i
  double variance_ppm2 = 0.0;
};

// Takes a step from the weights of S and R in the mean of cell i to those of R alone: p = C w_S,
// q = w_R + W^T w_S. Moments of the step so far are those given S and R.
void Condition(const Front& front, std::span<const double> weights, PathStep& step);

// A copy of all but the message.
std::shared_ptr<Front> WithoutMessage(const Front& front);

// The front once cell i has `precision` more on the diagonal and `weighted_deviation` more on the
// right-hand side: all but the message, which needs an elimination. Cost: a copy.
std::shared_ptr<const Front> AfterReading(const Front& front, const PathStep& step,
                                          double precision, double weighted_deviation);

}  // namespace plumescout
