// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/linalg/column_inverse.h"

#include <cstddef>

namespace plumescout {
namespace {

// The inverse Z, last column first. With l = L_rj / L_jj over the rows r of column j:
// Z_rj = -sum_q Z_rq l_q.
class ScalarTakahashi {
 public:
  explicit ScalarTakahashi(const FactorColumns& factor)
      : factor_(factor),
        scaled_(static_cast<std::size_t>(factor.n)),
        sum_(static_cast<std::size_t>(factor.n)),
        column_of_(static_cast<std::size_t>(factor.n), -1) {}

  std::vector<double> Run() {
    std::vector<double> diagonal(static_cast<std::size_t>(factor_.n));
    for (int j = factor_.n - 1; j >= 0; --j) diagonal[At(j)] = Column(j);
    return diagonal;
  }

 private:
  // Overwrites column j of L with that of Z; returns Z_jj.
  double Column(int j) {
    const int begin = factor_.begin[j];
    const int end = begin + factor_.size[j];
    const double pivot = factor_.value[begin];
    for (int k = begin + 1; k < end; ++k) {
      const int row = factor_.row[k];
      scaled_[At(row)] = factor_.value[k] / pivot;
      sum_[At(row)] = 0.0;
      column_of_[At(row)] = j;
    }
    for (int k = begin + 1; k < end; ++k) AddColumn(factor_.row[k], j);
    double diagonal = 1.0 / (pivot * pivot);
    for (int k = begin + 1; k < end; ++k) {
      const int row = factor_.row[k];
      factor_.value[k] = -sum_[At(row)];
      diagonal += scaled_[At(row)] * sum_[At(row)];
    }
    factor_.value[begin] = diagonal;
    return diagonal;
  }

  // Column q of Z, and by symmetry its row, into the sums of column j.
  void AddColumn(int q, int j) {
    const int begin = factor_.begin[q];
    sum_[At(q)] += factor_.value[begin] * scaled_[At(q)];
    for (int k = begin + 1; k < begin + factor_.size[q]; ++k) {
      const int row = factor_.row[k];
      if (column_of_[At(row)] != j) continue;
      sum_[At(row)] += factor_.value[k] * scaled_[At(q)];
      sum_[At(q)] += factor_.value[k] * scaled_[At(row)];
    }
  }

  static std::size_t At(int index) { return static_cast<std::size_t>(index); }

  FactorColumns factor_;
  std::vector<double> scaled_;  // l, by row
  std::vector<double> sum_;     // by row
  std::vector<int> column_of_;  // the column whose pattern a row was last in
};

}  // namespace

std::vector<double> InvertOnPattern(const FactorColumns& factor) {
  return ScalarTakahashi(factor).Run();
}

}  // namespace plumescout
