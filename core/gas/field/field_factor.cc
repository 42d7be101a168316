// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_factor.h"

#include <algorithm>
#include <utility>

namespace plumescout {

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

}  // namespace plumescout
