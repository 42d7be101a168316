// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_solve.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace plumescout {
namespace {

// Node by node, the elimination and the substitution back, in place: `values` are the right-hand
// side, then C g_S with what descendants passed on, then the solution.
class Solver {
 public:
  Solver(const FieldFactor& factor, std::vector<double>& values)
      : factor_(factor), values_(values) {}

  // g_R += W^T g_S, g_S = C g_S.
  void Eliminate(const Front& front) {
    const std::span<const Slot> own = front.own_cells();
    weights_.assign(front.cells.size(), 0.0);
    for (std::size_t i = 0; i < own.size(); ++i) weights_[i] = values_[own[i]];
    const bool says_nothing =
        std::all_of(weights_.begin(), weights_.end(), [](double g) { return g == 0.0; });
    if (says_nothing) return;
    PathStep step;
    Condition(front, weights_, step);
    for (std::size_t i = 0; i < own.size(); ++i) values_[own[i]] = step.own[i];
    const std::span<const Slot> boundary = front.boundary_cells();
    for (std::size_t i = 0; i < boundary.size(); ++i) values_[boundary[i]] += step.boundary[i];
  }

  // x_S = C g_S + W x_R.
  void Substitute(const Front& front) {
    const std::span<const Slot> own = front.own_cells();
    own_.clear();
    for (const Slot slot : own) own_.push_back(values_[slot]);
    boundary_.clear();
    for (const Slot slot : front.boundary_cells()) boundary_.push_back(values_[slot]);
    front.AddWeighted(boundary_, scratch_, own_.data());
    for (std::size_t i = 0; i < own.size(); ++i) values_[own[i]] = own_[i];
  }

  // Cells that are in no front are not active.
  void Clear() {
    std::vector<double> active(values_.size(), 0.0);
    for (std::size_t node = 0; node < factor_.tree().nodes().size(); ++node) {
      for (const Slot slot : factor_.front(node).own_cells()) active[slot] = values_[slot];
    }
    values_.swap(active);
  }

 private:
  const FieldFactor& factor_;
  std::vector<double>& values_;
  std::vector<double> weights_;
  std::vector<double> own_;
  std::vector<double> boundary_;
  std::vector<double> scratch_;
};

}  // namespace

std::vector<double> SolveField(const FieldFactor& factor, std::span<const double> right_side) {
  std::vector<double> values(right_side.begin(), right_side.end());
  Solver solver(factor, values);
  solver.Clear();
  const std::size_t nodes = factor.tree().nodes().size();
  for (std::size_t node = 0; node < nodes; ++node) solver.Eliminate(factor.front(node));
  for (std::size_t node = nodes; node-- > 0;) solver.Substitute(factor.front(node));
  return values;
}

}  // namespace plumescout
