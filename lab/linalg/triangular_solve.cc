// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/linalg/triangular_solve.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/linalg/dense_kernel.h"

namespace plumescout::lab {
namespace {

std::size_t Unsigned(int index) { return static_cast<std::size_t>(index); }

class TriangularSolver {
 public:
  TriangularSolver(const SupernodalPattern& pattern, const FactorValues& factor, double* x)
      : pattern_(pattern), factor_(factor), x_(x), below_(Unsigned(pattern.n)) {}

  // x = L^-1 x
  void Forward() {
    for (std::size_t s = 0; s < pattern_.parent.size(); ++s) {
      const Panel panel = At(s);
      std::fill_n(below_.begin(), panel.rows - panel.columns, 0.0);
      for (std::size_t j = 0; j < panel.columns; ++j) {
        const double* column = panel.values + j * panel.rows;
        const double value = panel.x[j] /= column[j];
        for (std::size_t i = j + 1; i < panel.columns; ++i) panel.x[i] -= column[i] * value;
        const double* below = column + panel.columns;
        const std::size_t size = panel.rows - panel.columns;
        for (std::size_t i = 0; i < size; ++i) below_[i] += below[i] * value;
      }
      for (std::size_t i = panel.columns; i < panel.rows; ++i) {
        x_[panel.row[i]] -= below_[i - panel.columns];
      }
    }
  }

  // x = L^-T x
  void Backward() {
    for (std::size_t s = pattern_.parent.size(); s-- > 0;) {
      const Panel panel = At(s);
      const std::size_t size = panel.rows - panel.columns;
      for (std::size_t i = 0; i < size; ++i) below_[i] = x_[panel.row[panel.columns + i]];
      for (std::size_t j = panel.columns; j-- > 0;) {
        const double* column = panel.values + j * panel.rows;
        const double sum = Dot(column + panel.columns, below_.data(), size) +
                           Dot(column + j + 1, panel.x + j + 1, panel.columns - j - 1);
        panel.x[j] = (panel.x[j] - sum) / column[j];
      }
    }
  }

 private:
  struct Panel {
    const double* values;  // rows x columns
    const int* row;        // rows
    double* x;             // of its own columns
    std::size_t rows;
    std::size_t columns;
  };
  Panel At(std::size_t s) const {
    return {factor_.data() + pattern_.first_value[s], pattern_.row.data() + pattern_.first_row[s],
            x_ + pattern_.first_column[s], pattern_.rows(s), pattern_.columns(s)};
  }

  const SupernodalPattern& pattern_;
  const FactorValues& factor_;
  double* x_;
  std::vector<double> below_;
};

}  // namespace

void SolveSupernodes(const SupernodalPattern& pattern, const FactorValues& factor,
                     std::span<const double> b, std::span<double> x) {
  const std::size_t n = Unsigned(pattern.n);
  std::vector<double> permuted(n);
  for (std::size_t k = 0; k < n; ++k) permuted[k] = b[Unsigned(pattern.order[k])];
  TriangularSolver solver(pattern, factor, permuted.data());
  solver.Forward();
  solver.Backward();
  for (std::size_t k = 0; k < n; ++k) x[Unsigned(pattern.order[k])] = permuted[k];
}

}  // namespace plumescout::lab
