// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// The product's only user of CHOLMOD.
#include "core/linalg/cholmod_solve.h"

#include <cholmod.h>

#include <cstddef>
#include <memory>

#include "absl/strings/str_cat.h"
#include "core/linalg/column_inverse.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// cholmod_common with a lifetime; never prints.
class Workspace {
 public:
  Workspace() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.postorder = 1;
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_asis = 0;
    common_.final_ll = 1;
  }
  ~Workspace() { cholmod_finish(&common_); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  cholmod_common* get() { return &common_; }
  absl::Status status() const {
    switch (common_.status) {
      case CHOLMOD_OK:
        return absl::OkStatus();
      case CHOLMOD_NOT_POSDEF:
        return absl::FailedPreconditionError("CHOLMOD: not positive definite");
      case CHOLMOD_OUT_OF_MEMORY:
      case CHOLMOD_TOO_LARGE:
        return absl::ResourceExhaustedError("CHOLMOD: the factor does not fit into memory");
      default:
        return absl::InternalError(absl::StrCat("CHOLMOD: status ", common_.status));
    }
  }

 private:
  cholmod_common common_;
};

// CHOLMOD does not write to what these name.
cholmod_sparse View(const SymmetricMatrix& matrix) {
  cholmod_sparse view = {};
  view.nrow = view.ncol = static_cast<std::size_t>(matrix.n);
  view.nzmax = matrix.row.size();
  view.p = const_cast<int*>(matrix.column_start.data());
  view.i = const_cast<int*>(matrix.row.data());
  view.x = const_cast<double*>(matrix.value.data());
  view.stype = -1;  // lower triangle
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

cholmod_dense View(std::span<const double> values) {
  cholmod_dense view = {};
  view.nrow = view.d = view.nzmax = values.size();
  view.ncol = 1;
  view.x = const_cast<double*>(values.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

// In the order of A's unknowns, that of the factor's columns.
std::vector<double> InverseDiagonal(const cholmod_factor& factor) {
  const std::vector<double> by_column =
      InvertOnPattern({static_cast<int>(factor.n), static_cast<const int*>(factor.p),
                       static_cast<const int*>(factor.nz), static_cast<const int*>(factor.i),
                       static_cast<double*>(factor.x)});
  const int* const order = static_cast<const int*>(factor.Perm);
  std::vector<double> diagonal(by_column.size());
  for (std::size_t k = 0; k < by_column.size(); ++k) {
    diagonal[static_cast<std::size_t>(order[k])] = by_column[k];
  }
  return diagonal;
}

}  // namespace

absl::StatusOr<CholmodSolution> SolveByCholmod(const SymmetricMatrix& matrix,
                                               std::span<const double> b) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(matrix));
  if (b.size() != static_cast<std::size_t>(matrix.n)) {
    return absl::InvalidArgumentError(
        absl::StrCat("CHOLMOD: ", b.size(), " values for n = ", matrix.n));
  }
  if (matrix.n == 0) return CholmodSolution();
  Workspace workspace;
  cholmod_sparse a = View(matrix);
  const auto free_factor = [&](cholmod_factor* f) { cholmod_free_factor(&f, workspace.get()); };
  const std::unique_ptr<cholmod_factor, decltype(free_factor)> factor(
      cholmod_analyze(&a, workspace.get()), free_factor);
  PLUMESCOUT_RETURN_IF_ERROR(workspace.status());
  cholmod_factorize(&a, factor.get(), workspace.get());
  PLUMESCOUT_RETURN_IF_ERROR(workspace.status());
  if (factor->is_super != 0 || factor->is_ll == 0) {
    return absl::InternalError("CHOLMOD: not the factor that was asked for");
  }
  cholmod_dense right = View(b);
  const auto free_dense = [&](cholmod_dense* d) { cholmod_free_dense(&d, workspace.get()); };
  const std::unique_ptr<cholmod_dense, decltype(free_dense)> x(
      cholmod_solve(CHOLMOD_A, factor.get(), &right, workspace.get()), free_dense);
  PLUMESCOUT_RETURN_IF_ERROR(workspace.status());
  const auto* const values = static_cast<const double*>(x->x);
  return CholmodSolution{{values, values + b.size()}, InverseDiagonal(*factor)};
}

}  // namespace plumescout
