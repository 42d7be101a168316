// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/linalg/selected_inverse.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/linalg/dense_kernel.h"

namespace plumescout::lab {
namespace {

std::size_t Unsigned(int index) { return static_cast<std::size_t>(index); }

// Dense column-major scratch that keeps its memory.
class Block {
 public:
  void Resize(std::size_t rows, std::size_t columns) {
    stride_ = PaddedRows(rows);
    values_.resize(std::max(values_.size(), stride_ * columns));
  }
  void Zero(std::size_t rows, std::size_t columns) {
    Resize(rows, columns);
    std::fill_n(values_.begin(), stride_ * columns, 0.0);
  }
  std::size_t stride() const { return stride_; }
  double* column(std::size_t j) { return values_.data() + j * stride_; }
  const double* column(std::size_t j) const { return values_.data() + j * stride_; }

 private:
  std::vector<double> values_;
  std::size_t stride_ = 0;
};

// Blocks of Z over the rows of supernodes that still have children to come, along one path from a
// root. Each is a full square, column-major with stride PaddedRows(rows).
class PathOfBlocks {
 public:
  // Drops what lies below `parent` (-1: everything).
  void Rewind(int parent) {
    while (!items_.empty() && items_.back().supernode != parent) items_.pop_back();
  }
  const double* top() const { return values_.data() + items_.back().begin; }
  // The memory of a new block, uninitialised; top() moves to it. Invalidates earlier pointers.
  double* Push(int supernode, std::size_t size) {
    const std::size_t begin = items_.empty() ? 0 : items_.back().end;
    if (values_.size() < begin + size) values_.resize(begin + size);
    items_.push_back({supernode, begin, begin + size});
    return values_.data() + begin;
  }

 private:
  struct Item {
    int supernode;
    std::size_t begin;
    std::size_t end;
  };
  std::vector<double> values_;
  std::vector<Item> items_;
};

class SelectedInversion {
 public:
  SelectedInversion(const SupernodalPattern& pattern, const FactorValues& factor,
                    std::span<double> diagonal)
      : pattern_(pattern), factor_(factor), diagonal_(diagonal) {}

  void Run() {
    for (std::size_t s = pattern_.parent.size(); s-- > 0;) Visit(s);
  }

 private:
  void Visit(std::size_t s) {
    columns_ = pattern_.columns(s);
    below_ = pattern_.rows(s) - columns_;
    path_.Rewind(pattern_.parent[s]);
    FormXY(s);
    if (below_ > 0) {
      GatherBelow(s);
      FormZY();
    }
    if (pattern_.child_count[s] == 0) {
      PublishLeaf(s);
    } else {
      double* z = path_.Push(static_cast<int>(s), pattern_.rows(s) * PaddedRows(pattern_.rows(s)));
      FormBlock(z, PaddedRows(pattern_.rows(s)));
      for (std::size_t j = 0; j < columns_; ++j) {
        Publish(s, j, z[j * PaddedRows(pattern_.rows(s)) + j]);
      }
    }
  }

  // X = L11^-1, Y = L21 X.
  void FormXY(std::size_t s) {
    const double* panel = factor_.data() + pattern_.first_value[s];
    const std::size_t rows = pattern_.rows(s);
    x_.Resize(columns_, columns_);
    InvertLower(panel, rows, columns_, x_.column(0), x_.stride());
    y_.Zero(below_, columns_);
    Accumulate({.a = panel + columns_,
                .a_stride = rows,
                .b = x_.column(0),
                .b_column_stride = x_.stride(),
                .c = y_.column(0),
                .c_stride = y_.stride(),
                .rows = below_,
                .columns = columns_,
                .depth = columns_});
  }

  // Z_RR, out of the parent's block.
  void GatherBelow(std::size_t s) {
    const auto parent = Unsigned(pattern_.parent[s]);
    const std::size_t stride = PaddedRows(pattern_.rows(parent));
    const int* place = pattern_.parent_row.data() + pattern_.first_row[s] + columns_;
    z_below_.Resize(below_, below_);
    for (std::size_t j = 0; j < below_; ++j) {
      const double* from = path_.top() + Unsigned(place[j]) * stride;
      double* to = z_below_.column(j);
      for (std::size_t i = 0; i < below_; ++i) to[i] = from[place[i]];
    }
  }

  // Z_RR Y
  void FormZY() {
    zy_.Zero(below_, columns_);
    Accumulate({.a = z_below_.column(0),
                .a_stride = z_below_.stride(),
                .b = y_.column(0),
                .b_column_stride = y_.stride(),
                .c = zy_.column(0),
                .c_stride = zy_.stride(),
                .rows = below_,
                .columns = columns_,
                .depth = below_});
  }

  // Nobody asks for the off-diagonal entries of a leaf.
  void PublishLeaf(std::size_t s) {
    for (std::size_t j = 0; j < columns_; ++j) {
      double value = Dot(x_.column(j) + j, x_.column(j) + j, columns_ - j);
      if (below_ > 0) value += Dot(y_.column(j), zy_.column(j), below_);
      Publish(s, j, value);
    }
  }

  // [Z_SS Z_SR; Z_RS Z_RR] into z.
  void FormBlock(double* z, std::size_t stride) {
    for (std::size_t j = 0; j < columns_; ++j) std::fill_n(z + j * stride, stride, 0.0);
    AddTransposedProduct(x_, x_, columns_, z, stride);
    if (below_ > 0) AddTransposedProduct(y_, zy_, below_, z, stride);
    for (std::size_t j = 0; j < columns_; ++j) {
      const double* column = zy_.column(j);
      for (std::size_t i = 0; i < below_; ++i) {
        z[j * stride + columns_ + i] = -column[i];
        z[(columns_ + i) * stride + j] = -column[i];
      }
    }
    for (std::size_t j = 0; j < below_; ++j) {
      std::copy_n(z_below_.column(j), below_, z + (columns_ + j) * stride + columns_);
    }
  }

  // z += a^T b for a, b: depth x columns_.
  void AddTransposedProduct(const Block& a, const Block& b, std::size_t depth, double* z,
                            std::size_t stride) {
    transposed_.Resize(columns_, depth);
    for (std::size_t j = 0; j < columns_; ++j) {
      for (std::size_t i = 0; i < depth; ++i) transposed_.column(i)[j] = a.column(j)[i];
    }
    Accumulate({.a = transposed_.column(0),
                .a_stride = transposed_.stride(),
                .b = b.column(0),
                .b_column_stride = b.stride(),
                .c = z,
                .c_stride = stride,
                .rows = columns_,
                .columns = columns_,
                .depth = depth});
  }

  void Publish(std::size_t s, std::size_t j, double value) {
    const std::size_t column = Unsigned(pattern_.first_column[s]) + j;
    diagonal_[Unsigned(pattern_.order[column])] = value;
  }

  const SupernodalPattern& pattern_;
  const FactorValues& factor_;
  std::span<double> diagonal_;
  PathOfBlocks path_;
  std::size_t columns_ = 0;  // of the present supernode: |S|
  std::size_t below_ = 0;    // |R|
  Block x_, y_, z_below_, zy_, transposed_;
};

}  // namespace

void InverseDiagonalSupernodes(const SupernodalPattern& pattern, const FactorValues& factor,
                               std::span<double> diagonal) {
  SelectedInversion(pattern, factor, diagonal).Run();
}

}  // namespace plumescout::lab
