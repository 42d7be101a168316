// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/gas_peers.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <cstddef>
#include <utility>

#include "core/linalg/cholmod_solve.h"
#include "core/linalg/column_inverse.h"
#include "core/types/status_macros.h"

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

}  // namespace

absl::StatusOr<PeerPosterior> SolveByCholmod(const Information& information) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      CholmodSolution solution,
      plumescout::SolveByCholmod(information.hessian, information.negative_gradient));
  return PeerPosterior{std::move(solution.x), std::move(solution.inverse_diagonal)};
}

absl::StatusOr<PeerPosterior> SolveByEigen(const Information& information) {
  if (information.hessian.n == 0) return PeerPosterior();
  Eigen::SimplicialLLT<Sparse, Eigen::Lower> llt;
  llt.compute(AsEigen(information.hessian));
  if (llt.info() != Eigen::Success) return absl::InternalError("Eigen failed");
  PeerPosterior posterior;
  posterior.deviation_ppm = ToVector(llt.solve(AsEigen(information.negative_gradient)));
  Sparse l = llt.matrixL();
  std::vector<int> sizes;
  for (int j = 0; j < information.hessian.n; ++j) {
    sizes.push_back(l.outerIndexPtr()[j + 1] - l.outerIndexPtr()[j]);
  }
  const std::vector<double> diagonal = InvertOnPattern(
      {information.hessian.n, l.outerIndexPtr(), sizes.data(), l.innerIndexPtr(), l.valuePtr()});
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
