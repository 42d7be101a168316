// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_factor.h"

#include <algorithm>
#include <utility>

namespace plumescout {
namespace {

// Scratch of the way down.
struct Descent {
  std::vector<double> boundary;  // x_R, cell by cell
  std::vector<double> own;       // x_S, column by column
  std::vector<double> weights;
};

// x_S += W x_R for one column.
void DescendOne(const Front& front, double* x, Descent& scratch) {
  scratch.boundary.clear();
  for (const Slot slot : front.boundary_cells()) scratch.boundary.push_back(x[slot]);
  scratch.own.assign(front.own, 0.0);
  front.AddWeighted(scratch.boundary, scratch.weights, scratch.own.data());
  for (std::size_t i = 0; i < front.own; ++i) x[front.cells[i]] += scratch.own[i];
}

// The same for several columns at once.
void DescendMany(const Front& front, SlotColumns& x, Descent& scratch) {
  const std::size_t columns = x.columns();
  const std::size_t stride = TileRows(front.own);
  const std::span<const Slot> boundary = front.boundary_cells();
  scratch.boundary.resize(boundary.size() * columns);
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    std::copy_n(x.row(boundary[i]), columns, scratch.boundary.data() + i * columns);
  }
  scratch.own.resize(stride * columns);
  Accumulate({.a = front.Weights(scratch.weights),
              .a_stride = front.own,
              .b = scratch.boundary.data(),
              .b_row_stride = columns,
              .b_column_stride = 1,
              .c = scratch.own.data(),
              .c_stride = stride,
              .rows = front.own,
              .columns = columns,
              .depth = boundary.size(),
              .overwrite = true});
  for (std::size_t i = 0; i < front.own; ++i) {
    double* const row = x.row(front.cells[i]);
    for (std::size_t j = 0; j < columns; ++j) row[j] += scratch.own[j * stride + i];
  }
}

void DescendFront(const Front& front, SlotColumns& x, Descent& scratch) {
  if (front.own == 0 || front.boundary() == 0) return;
  if (x.columns() == 1) {
    DescendOne(front, x.row(0), scratch);
  } else {
    DescendMany(front, x, scratch);
  }
}

}  // namespace

void FieldFactor::Eliminate(std::span<const std::uint8_t> dirty, const FieldCells& cells,
                            FrontBuilder& builder) {
  for (std::size_t i = 0; i < fronts_.size(); ++i) {
    if (dirty[i] == 0) continue;
    const SeparatorTree::Node& node = tree_->nodes()[i];
    const Front* const low = node.is_leaf() ? nullptr : fronts_[node.children[0]].get();
    const Front* const high = node.is_leaf() ? nullptr : fronts_[node.children[1]].get();
    fronts_[i] = builder.Build(node, cells, low, high);
  }
}

double FieldFactor::work() const {
  double sum = 0.0;
  for (const auto& front : fronts_) sum += front->work();
  return sum;
}

std::vector<PathStep> FieldFactor::StepsFrom(Slot slot) const {
  std::vector<PathStep> steps;
  std::vector<double> weights;  // of the cells of the front in the mean of the cell given them
  std::vector<std::uint32_t> places;
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
      FindPlaces(fronts_[below.node]->boundary_cells(), front.cells, places);
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

PathColumns FieldFactor::InverseOnPaths(std::span<const Slot> slots) const {
  PathColumns columns{SlotColumns(tree_->cells(), slots.size()), {}};
  std::vector<std::uint32_t>& nodes = columns.path_nodes;
  for (std::size_t j = 0; j < slots.size(); ++j) {
    for (const PathStep& step : StepsFrom(slots[j])) {
      nodes.push_back(step.node);
      const Front& front = *fronts_[step.node];
      for (std::size_t i = 0; i < front.own; ++i) {
        columns.values.row(front.cells[i])[j] = step.own[i];
      }
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  Descent scratch;
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    DescendFront(*fronts_[*node], columns.values, scratch);
  }
  return columns;
}

SlotColumns FieldFactor::Extend(PathColumns columns) const {
  Descent scratch;
  auto known = columns.path_nodes.rbegin();
  for (std::size_t node = fronts_.size(); node-- > 0;) {
    if (known != columns.path_nodes.rend() && *known == node) {
      ++known;
    } else {
      DescendFront(*fronts_[node], columns.values, scratch);
    }
  }
  return std::move(columns.values);
}

}  // namespace plumescout
