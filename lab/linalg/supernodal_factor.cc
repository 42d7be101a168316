// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/linalg/supernodal_factor.h"

#include <algorithm>
#include <cstddef>

#include "absl/strings/str_cat.h"
#include "core/linalg/dense_kernel.h"

namespace plumescout::lab {
namespace {

std::size_t Unsigned(int index) { return static_cast<std::size_t>(index); }

// Schur complements that wait for their parent, the last supernode's on top. Postorder puts the
// children of a supernode on top when its turn comes. Each is the lower triangle of a dense square,
// column-major without padding.
class SchurStack {
 public:
  void Push(std::size_t supernode, std::size_t rows, const double* front, std::size_t stride) {
    const std::size_t begin = values_.size();
    values_.resize(begin + rows * rows);
    for (std::size_t j = 0; j < rows; ++j) {
      std::copy(front + j * stride + j, front + j * stride + rows,
                values_.begin() + static_cast<std::ptrdiff_t>(begin + j * rows + j));
    }
    items_.push_back({supernode, begin});
  }
  std::size_t top_supernode() const { return items_.back().supernode; }
  const double* top_values() const { return values_.data() + items_.back().begin; }
  void Pop() {
    values_.resize(items_.back().begin);
    items_.pop_back();
  }

 private:
  struct Item {
    std::size_t supernode;
    std::size_t begin;
  };
  std::vector<double> values_;
  std::vector<Item> items_;
};

class Factorization {
 public:
  Factorization(const SupernodalPattern& pattern, std::span<const double> matrix_values)
      : pattern_(pattern), matrix_values_(matrix_values), place_(Unsigned(pattern.n)) {
    factor_.resize(pattern.first_value.back() + kRowTile);
  }

  // The first column of L whose pivot is not positive, or n.
  std::size_t Run() {
    for (std::size_t s = 0; s < pattern_.parent.size(); ++s) {
      Assemble(s);
      const std::size_t done =
          FactorizeFront(front_.data(), stride_, pattern_.rows(s), pattern_.columns(s));
      if (done != pattern_.columns(s)) return Unsigned(pattern_.first_column[s]) + done;
      Store(s);
    }
    return Unsigned(pattern_.n);
  }
  FactorValues Take() { return std::move(factor_); }

 private:
  void Assemble(std::size_t s) {
    const std::size_t rows = pattern_.rows(s);
    stride_ = PaddedRows(rows);
    front_.assign(rows * stride_, 0.0);
    AddMatrixEntries(s);
    for (int child = 0; child < pattern_.child_count[s]; ++child) AddTopOfStack();
  }

  void AddMatrixEntries(std::size_t s) {
    for (std::size_t k = pattern_.first_row[s]; k < pattern_.first_row[s + 1]; ++k) {
      place_[Unsigned(pattern_.row[k])] = static_cast<int>(k - pattern_.first_row[s]);
    }
    for (std::size_t j = 0; j < pattern_.columns(s); ++j) {
      const std::size_t column = Unsigned(pattern_.first_column[s]) + j;
      for (int e = pattern_.first_entry[column]; e < pattern_.first_entry[column + 1]; ++e) {
        const SupernodalPattern::Entry& entry = pattern_.entry[Unsigned(e)];
        front_[j * stride_ + Unsigned(place_[Unsigned(entry.row)])] +=
            matrix_values_[Unsigned(entry.source)];
      }
    }
  }

  void AddTopOfStack() {
    const std::size_t child = schur_.top_supernode();
    const std::size_t rows = pattern_.rows(child) - pattern_.columns(child);
    const int* place = pattern_.parent_row.data() + pattern_.first_row[child + 1] - rows;
    const double* from = schur_.top_values();
    for (std::size_t j = 0; j < rows; ++j, from += rows) {
      double* to = front_.data() + Unsigned(place[j]) * stride_;
      for (std::size_t i = j; i < rows; ++i) to[place[i]] += from[i];
    }
    schur_.Pop();
  }

  void Store(std::size_t s) {
    const std::size_t rows = pattern_.rows(s);
    const std::size_t columns = pattern_.columns(s);
    double* panel = factor_.data() + pattern_.first_value[s];
    for (std::size_t j = 0; j < columns; ++j) {
      std::copy_n(front_.data() + j * stride_, rows, panel + j * rows);
    }
    if (pattern_.parent[s] < 0) return;
    schur_.Push(s, rows - columns, front_.data() + columns * stride_ + columns, stride_);
  }

  const SupernodalPattern& pattern_;
  std::span<const double> matrix_values_;
  std::vector<int> place_;     // of a row of L in the present front
  std::vector<double> front_;  // rows x rows, lower triangle
  std::size_t stride_ = 0;
  SchurStack schur_;
  FactorValues factor_;
};

}  // namespace

absl::StatusOr<FactorValues> FactorizeSupernodes(const SupernodalPattern& pattern,
                                                 std::span<const double> matrix_values) {
  Factorization factorization(pattern, matrix_values);
  const std::size_t done = factorization.Run();
  if (done != Unsigned(pattern.n)) {
    return absl::FailedPreconditionError(
        absl::StrCat("sparse Cholesky: not positive definite at unknown ", pattern.order[done]));
  }
  return factorization.Take();
}

}  // namespace plumescout::lab
