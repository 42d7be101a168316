// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_factor.h"

#include <algorithm>
#include <utility>

namespace plumescout {
namespace {

// The front once the cells below it have been read: C -= P K^-1 P^T, W -= P K^-1 Q^T with P and Q
// those of the step, and K what the cells vary by together given the boundary, and the noise.
class Conditioning {
 public:
  std::shared_ptr<const Front> After(const Front& front, const ReadingPaths::Step& step,
                                     std::span<const double> noise_ppm2) {
    std::shared_ptr<Front> after = WithoutMessage(front);
    if (front.own == 0) return after;
    FindGain(step, noise_ppm2.subspan(step.first, step.cells));
    Whiten(step.own, front.own, step, own_);
    Transpose(front.own, step);
    SubtractFromCovariance(step.cells, *after);
    if (front.boundary() == 0) return after;
    Whiten(step.boundary, front.boundary(), step, boundary_);
    if (!front.weights.empty()) SubtractFromWeights(step, *after);
    SubtractFromWeightSums(step, *after);
    return after;
  }

 private:
  // L^-1, with K = L L^T.
  void FindGain(const ReadingPaths::Step& step, std::span<const double> noise_ppm2) {
    stride_ = PaddedRows(step.cells);
    matrix_.assign(stride_ * step.cells, 0.0);
    for (std::size_t j = 0; j < step.cells; ++j) {
      std::copy_n(step.among + j * step.stride() + j, step.cells - j,
                  matrix_.data() + j * stride_ + j);
      matrix_[j * stride_ + j] += noise_ppm2[j];
    }
    FactorizeFront(matrix_.data(), stride_, step.cells, step.cells);
    inverse_.assign(stride_ * step.cells, 0.0);
    InvertLower(matrix_.data(), stride_, step.cells, inverse_.data(), stride_);
  }

  // Each of the rows x becomes L^-1 x.
  void Whiten(const double* rows, std::size_t count, const ReadingPaths::Step& step,
              std::vector<double>& whitened) const {
    const std::size_t stride = step.stride();
    whitened.resize(std::max(whitened.size(), count * stride));
    Accumulate({.a = inverse_.data(),
                .a_stride = stride_,
                .b = rows,
                .b_row_stride = 1,
                .b_column_stride = stride,
                .c = whitened.data(),
                .c_stride = stride,
                .rows = stride,
                .columns = count,
                .depth = step.cells,
                .overwrite = true});
  }

  // Of own_, by columns.
  void Transpose(std::size_t own, const ReadingPaths::Step& step) {
    column_stride_ = TileRows(own);
    columns_.assign(column_stride_ * step.cells, 0.0);
    for (std::size_t i = 0; i < own; ++i) {
      for (std::size_t j = 0; j < step.cells; ++j) {
        columns_[j * column_stride_ + i] = own_[i * step.stride() + j];
      }
    }
  }

  void SubtractFromCovariance(std::size_t cells, Front& front) {
    const std::size_t own = front.own;
    product_.assign(column_stride_ * own, 0.0);
    Accumulate({.a = columns_.data(),
                .a_stride = column_stride_,
                .b = columns_.data(),
                .b_row_stride = column_stride_,
                .b_column_stride = 1,
                .c = product_.data(),
                .c_stride = column_stride_,
                .rows = own,
                .columns = own,
                .depth = cells,
                .lower_only = true});
    double* value = front.covariance.data();
    for (std::size_t j = 0; j < own; ++j) {
      const double* const column = product_.data() + j * column_stride_;
      for (std::size_t i = j; i < own; ++i) *value++ -= column[i];
    }
  }

  // A tile leaves what lies beyond a column as it is: the rows of columns_ there are 0.
  void SubtractFromWeights(const ReadingPaths::Step& step, Front& front) const {
    Accumulate({.a = columns_.data(),
                .a_stride = column_stride_,
                .b = boundary_.data(),
                .b_row_stride = 1,
                .b_column_stride = step.stride(),
                .c = front.weights.data(),
                .c_stride = front.own,
                .rows = front.own,
                .columns = front.boundary(),
                .depth = step.cells,
                .scale = -1.0});
  }

  void SubtractFromWeightSums(const ReadingPaths::Step& step, Front& front) {
    boundary_sum_.assign(step.stride(), 0.0);
    for (std::size_t r = 0; r < front.boundary(); ++r) {
      const double* const row = boundary_.data() + r * step.stride();
      for (std::size_t j = 0; j < step.stride(); ++j) boundary_sum_[j] += row[j];
    }
    for (std::size_t i = 0; i < front.own; ++i) {
      const double* const row = own_.data() + i * step.stride();
      front.weight_sums[i] -= Dot(row, boundary_sum_.data(), step.cells);
    }
  }

  std::size_t stride_ = 0;  // of matrix_ and inverse_
  std::vector<double> matrix_;
  std::vector<double> inverse_;
  std::vector<double> own_;
  std::vector<double> boundary_;
  std::vector<double> boundary_sum_;
  std::size_t column_stride_ = 0;
  std::vector<double> columns_;
  std::vector<double> product_;
};

}  // namespace

bool FieldFactor::Eliminate(std::span<const std::uint8_t> dirty, const FieldCells& cells,
                            FrontBuilder& builder, const StopFn& stop) {
  for (std::size_t i = 0; i < fronts_.size(); ++i) {
    if (dirty[i] == 0) continue;
    if (Stops(stop)) return false;
    const SeparatorTree::Node& node = tree_->nodes()[i];
    const Front* const low = node.is_leaf() ? nullptr : fronts_[node.children[0]].get();
    const Front* const high = node.is_leaf() ? nullptr : fronts_[node.children[1]].get();
    fronts_[i] = builder.Build(node, cells, low, high);
  }
  return true;
}

double FieldFactor::work() const {
  double sum = 0.0;
  for (const auto& front : fronts_) sum += front->work();
  return sum;
}

std::vector<PathStep> FieldFactor::StepsFrom(Slot slot) const {
  std::vector<PathStep> steps;
  std::vector<double> weights;  // of the cells of the front in the mean of the cell given them
  for (std::uint32_t node = tree_->owner(slot); node != SeparatorTree::kNone;
       node = tree_->nodes()[node].parent) {
    const Front& front = *fronts_[node];
    weights.assign(front.cells.size(), 0.0);
    PathStep step;
    step.node = node;
    if (steps.empty()) {
      const auto place = std::lower_bound(front.cells.begin(), front.cells.end(), slot);
      weights[static_cast<std::size_t>(place - front.cells.begin())] = 1.0;
    } else {
      const PathStep& below = steps.back();
      const std::span<const std::uint32_t> places = PlacesInParent(below.node);
      for (std::size_t i = 0; i < places.size(); ++i) weights[places[i]] = below.boundary[i];
      step.mean_ppm = below.mean_ppm;
      step.variance_ppm2 = below.variance_ppm2;
    }
    Condition(front, weights, step);
    steps.push_back(std::move(step));
  }
  return steps;
}

void FieldFactor::AddReading(std::span<const PathStep> steps, double precision,
                             double weighted_deviation) {
  for (const PathStep& step : steps) {
    std::shared_ptr<const Front>& front = fronts_[step.node];
    front = AfterReading(*front, step, precision, weighted_deviation);
  }
}

void FieldFactor::AddForeseen(const ReadingPaths& paths, std::span<const double> noise_ppm2,
                              const StopFn& stop) {
  Conditioning conditioning;
  for (const ReadingPaths::Step& step : paths.steps()) {
    if (Stops(stop)) return;
    std::shared_ptr<const Front>& front = fronts_[step.node];
    front = conditioning.After(*front, step, noise_ppm2);
  }
}

}  // namespace plumescout
