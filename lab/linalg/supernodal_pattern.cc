// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// CHOLMOD orders and analyses, by its Supernodal module, which is GPL-2.0-or-later (see README,
// licences). The numbers are computed by our own kernels, because CHOLMOD's supernodal
// factorisation starts OpenMP threads and its bytes depend on the BLAS at hand.
#include "lab/linalg/supernodal_pattern.h"

#include <cholmod.h>

#include <algorithm>
#include <memory>
#include <span>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

std::size_t Unsigned(int index) { return static_cast<std::size_t>(index); }

// cholmod_common with a lifetime; never prints.
class Workspace {
 public:
  Workspace() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.postorder = 1;
  }
  ~Workspace() { cholmod_finish(&common_); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  cholmod_common* get() { return &common_; }

 private:
  cholmod_common common_;
};

// Names the pattern of `matrix` to CHOLMOD, which does not write to it.
cholmod_sparse PatternView(const SymmetricMatrix& matrix) {
  cholmod_sparse view = {};
  view.nrow = view.ncol = Unsigned(matrix.n);
  view.nzmax = matrix.row.size();
  view.p = const_cast<int*>(matrix.column_start.data());
  view.i = const_cast<int*>(matrix.row.data());
  view.stype = -1;  // lower triangle
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

absl::Status AnalysisError(int status) {
  if (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE) {
    return absl::ResourceExhaustedError("sparse Cholesky: the factor does not fit into memory");
  }
  return absl::InternalError(absl::StrCat("sparse Cholesky: CHOLMOD status ", status));
}

std::span<const int> Ints(const void* data, std::size_t size) {
  return {static_cast<const int*>(data), size};
}

void CopySupernodes(const cholmod_factor& factor, SupernodalPattern& pattern) {
  const std::size_t count = factor.nsuper;
  const auto order = Ints(factor.Perm, factor.n);
  const auto first_column = Ints(factor.super, count + 1);
  const auto first_row = Ints(factor.pi, count + 1);
  const auto row = Ints(factor.s, Unsigned(first_row.back()));
  pattern.order.assign(order.begin(), order.end());
  pattern.first_column.assign(first_column.begin(), first_column.end());
  pattern.first_row.assign(first_row.begin(), first_row.end());
  pattern.row.assign(row.begin(), row.end());
  pattern.parent.assign(count, -1);
  pattern.first_value.assign(count + 1, 0);
  for (std::size_t s = 0; s < count; ++s) {
    pattern.first_value[s + 1] = pattern.first_value[s] + pattern.rows(s) * pattern.columns(s);
  }
}

// The parent of a supernode holds its first row below as a column.
void LinkParents(SupernodalPattern& pattern) {
  std::vector<int> supernode_of_column(Unsigned(pattern.n));
  for (std::size_t s = 0; s < pattern.parent.size(); ++s) {
    std::fill(supernode_of_column.begin() + pattern.first_column[s],
              supernode_of_column.begin() + pattern.first_column[s + 1], static_cast<int>(s));
  }
  pattern.child_count.assign(pattern.parent.size(), 0);
  for (std::size_t s = 0; s < pattern.parent.size(); ++s) {
    if (pattern.rows(s) == pattern.columns(s)) continue;
    const int row = pattern.row[pattern.first_row[s] + pattern.columns(s)];
    pattern.parent[s] = supernode_of_column[Unsigned(row)];
    ++pattern.child_count[Unsigned(pattern.parent[s])];
  }
}

// Every row below a supernode is a row of its parent: both lists ascend, so one merge finds it.
void LocateRowsInParents(SupernodalPattern& pattern) {
  pattern.parent_row.assign(pattern.row.size(), 0);
  for (std::size_t s = 0; s < pattern.parent.size(); ++s) {
    if (pattern.parent[s] < 0) continue;
    const std::size_t parent_begin = pattern.first_row[Unsigned(pattern.parent[s])];
    std::size_t place = parent_begin;
    for (std::size_t k = pattern.first_row[s] + pattern.columns(s); k < pattern.first_row[s + 1];
         ++k) {
      while (pattern.row[place] < pattern.row[k]) ++place;
      pattern.parent_row[k] = static_cast<int>(place - parent_begin);
    }
  }
}

// Sorts the entries of A by their column in L (counting sort).
void MapEntries(const SymmetricMatrix& matrix, SupernodalPattern& pattern) {
  std::vector<int> position(Unsigned(matrix.n));
  for (int k = 0; k < matrix.n; ++k) position[Unsigned(pattern.order[Unsigned(k)])] = k;
  pattern.first_entry.assign(Unsigned(matrix.n) + 1, 0);
  pattern.entry.resize(matrix.row.size());
  const auto for_each_entry = [&](auto&& visit) {
    for (int j = 0; j < matrix.n; ++j) {
      for (int k = matrix.column_start[Unsigned(j)]; k < matrix.column_start[Unsigned(j) + 1];
           ++k) {
        const int a = position[Unsigned(j)];
        const int b = position[Unsigned(matrix.row[Unsigned(k)])];
        visit(k, std::max(a, b), std::min(a, b));
      }
    }
  };
  for_each_entry([&](int, int, int column) { ++pattern.first_entry[Unsigned(column) + 1]; });
  for (std::size_t j = 0; j < Unsigned(matrix.n); ++j) {
    pattern.first_entry[j + 1] += pattern.first_entry[j];
  }
  std::vector<int> next(pattern.first_entry.begin(), pattern.first_entry.end() - 1);
  for_each_entry([&](int source, int row, int column) {
    pattern.entry[Unsigned(next[Unsigned(column)]++)] = {source, row};
  });
}

}  // namespace

absl::StatusOr<SupernodalPattern> AnalyzePattern(const SymmetricMatrix& matrix) {
  Workspace workspace;
  cholmod_sparse view = PatternView(matrix);
  const auto free_factor = [&](cholmod_factor* f) { cholmod_free_factor(&f, workspace.get()); };
  const std::unique_ptr<cholmod_factor, decltype(free_factor)> factor(
      cholmod_analyze(&view, workspace.get()), free_factor);
  if (factor == nullptr || workspace.get()->status < CHOLMOD_OK) {
    return AnalysisError(workspace.get()->status);
  }
  if (!factor->is_super) return absl::InternalError("sparse Cholesky: no supernodes");
  SupernodalPattern pattern;
  pattern.n = matrix.n;
  CopySupernodes(*factor, pattern);
  LinkParents(pattern);
  LocateRowsInParents(pattern);
  MapEntries(matrix, pattern);
  return pattern;
}

}  // namespace plumescout::lab
