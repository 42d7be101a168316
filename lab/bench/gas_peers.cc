// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/gas_peers.h"

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <cstddef>

namespace plumescout::lab {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Eigen::Map<const Sparse> AsEigen(const SymmetricMatrix& matrix) {
  return {matrix.n,
          matrix.n,
          static_cast<Eigen::Index>(matrix.row.size()),
          matrix.column_start.data(),
          matrix.row.data(),
          matrix.value.data()};
}

Eigen::Map<const Eigen::VectorXd> AsEigen(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

std::vector<double> ToVector(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

// Lower triangle L by columns, the diagonal first in each.
struct FactorView {
  int n = 0;
  const int* begin = nullptr;  // of each column
  const int* size = nullptr;   // of each column
  const int* row = nullptr;
  const double* value = nullptr;
};

// Diagonal of (L L^T)^-1 by Takahashi's recursion: the inverse Z on the pattern of L, last column
// first. With l = L_rj / L_jj over the rows r of column j: Z_rj = -sum_q Z_rq l_q.
class ScalarTakahashi {
 public:
  explicit ScalarTakahashi(const FactorView& factor)
      : factor_(factor),
        z_(static_cast<std::size_t>(factor.begin[factor.n - 1] + factor.size[factor.n - 1])),
        scaled_(static_cast<std::size_t>(factor.n)),
        sum_(static_cast<std::size_t>(factor.n)),
        column_of_(static_cast<std::size_t>(factor.n), -1) {}

  std::vector<double> Diagonal() {
    std::vector<double> diagonal(static_cast<std::size_t>(factor_.n));
    for (int j = factor_.n - 1; j >= 0; --j) diagonal[static_cast<std::size_t>(j)] = Column(j);
    return diagonal;
  }

 private:
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
      z_[At(k)] = -sum_[At(row)];
      diagonal += scaled_[At(row)] * sum_[At(row)];
    }
    z_[At(begin)] = diagonal;
    return diagonal;
  }

  // Column q of Z, and by symmetry its row, into the sums of column j.
  void AddColumn(int q, int j) {
    const int begin = factor_.begin[q];
    sum_[At(q)] += z_[At(begin)] * scaled_[At(q)];
    for (int k = begin + 1; k < begin + factor_.size[q]; ++k) {
      const int row = factor_.row[k];
      if (column_of_[At(row)] != j) continue;
      sum_[At(row)] += z_[At(k)] * scaled_[At(q)];
      sum_[At(q)] += z_[At(k)] * scaled_[At(row)];
    }
  }

  static std::size_t At(int index) { return static_cast<std::size_t>(index); }

  FactorView factor_;
  std::vector<double> z_;       // on the pattern of L
  std::vector<double> scaled_;  // l, by row
  std::vector<double> sum_;     // by row
  std::vector<int> column_of_;  // the column whose pattern a row was last in
};

// Opens the factor that Eigen's wrapper keeps to itself.
class OpenCholmod : public Eigen::CholmodSimplicialLLT<Sparse, Eigen::Lower> {
 public:
  const cholmod_factor& factor() const { return *m_cholmodFactor; }
};

}  // namespace

absl::StatusOr<PeerPosterior> SolveByCholmod(const Information& information) {
  if (information.hessian.n == 0) return PeerPosterior();
  OpenCholmod cholmod;
  cholmod.cholmod().nmethods = 1;
  cholmod.cholmod().method[0].ordering = CHOLMOD_AMD;
  cholmod.compute(AsEigen(information.hessian));
  if (cholmod.info() != Eigen::Success) return absl::InternalError("CHOLMOD failed");
  PeerPosterior posterior;
  posterior.deviation_ppm = ToVector(cholmod.solve(AsEigen(information.negative_gradient)));
  const cholmod_factor& l = cholmod.factor();
  const std::vector<double> diagonal =
      ScalarTakahashi({information.hessian.n, static_cast<const int*>(l.p),
                       static_cast<const int*>(l.nz), static_cast<const int*>(l.i),
                       static_cast<const double*>(l.x)})
          .Diagonal();
  posterior.variance_ppm2.resize(diagonal.size());
  const int* order = static_cast<const int*>(l.Perm);
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    posterior.variance_ppm2[static_cast<std::size_t>(order[k])] = diagonal[k];
  }
  return posterior;
}

absl::StatusOr<PeerPosterior> SolveByEigen(const Information& information) {
  if (information.hessian.n == 0) return PeerPosterior();
  Eigen::SimplicialLLT<Sparse, Eigen::Lower> llt;
  llt.compute(AsEigen(information.hessian));
  if (llt.info() != Eigen::Success) return absl::InternalError("Eigen failed");
  PeerPosterior posterior;
  posterior.deviation_ppm = ToVector(llt.solve(AsEigen(information.negative_gradient)));
  const Sparse l = llt.matrixL();
  std::vector<int> sizes;
  for (int j = 0; j < information.hessian.n; ++j) {
    sizes.push_back(l.outerIndexPtr()[j + 1] - l.outerIndexPtr()[j]);
  }
  const std::vector<double> diagonal =
      ScalarTakahashi(
          {information.hessian.n, l.outerIndexPtr(), sizes.data(), l.innerIndexPtr(), l.valuePtr()})
          .Diagonal();
  for (const int position : llt.permutationP().indices()) {
    posterior.variance_ppm2.push_back(diagonal[static_cast<std::size_t>(position)]);
  }
  return posterior;
}

PeerPosterior SolveDensely(const Information& information) {
  const Sparse lower = AsEigen(information.hessian);
  const Eigen::MatrixXd hessian = Sparse(lower.selfadjointView<Eigen::Lower>());
  const Eigen::MatrixXd inverse = hessian.inverse();
  return {ToVector(inverse * AsEigen(information.negative_gradient)), ToVector(inverse.diagonal())};
}

}  // namespace plumescout::lab
