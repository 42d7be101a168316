// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/edge_cost.h"

#include <limits>

#include "core/grid/ray.h"

namespace plumescout {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

double SegmentIntegral_cells(const Grid<float>& raster, Point2 a, Point2 b) {
  return SegmentIntegralUpTo_cells(raster, a, b, kInfinity);
}

double SegmentIntegralUpTo_cells(const Grid<float>& raster, Point2 a, Point2 b, double most_cells) {
  const GridGeometry& geometry = raster.geometry();
  // Between two cells of the raster the walk never leaves it.
  const Cell first = geometry.CellAt(a);
  const Cell last = geometry.CellAt(b);
  if (!raster.Contains(first) || !raster.Contains(last)) return kInfinity;
  double sum = 0.0;
  const bool passed = WalkSegment(geometry, a, first, b, last, [&](Cell cell, double length_cells) {
    const double value = raster[cell];
    if (value == kInfinity) return false;
    sum += value * length_cells;
    return sum <= most_cells;
  });
  return passed ? sum : kInfinity;
}

double OpenSegmentIntegral_cells(const Grid<float>& raster, Point2 a, Point2 b,
                                 double blocked_value) {
  double sum = 0.0;
  WalkSegment(raster.geometry(), a, b, [&](Cell cell, double length_cells) {
    const double value = raster.At(cell, std::numeric_limits<float>::infinity());
    sum += (value == kInfinity ? blocked_value : value) * length_cells;
    return true;
  });
  return sum;
}

EdgeCost::EdgeCost(const InformationMap& information, CostKind kind, double alpha_per_m)
    : information_(&information),
      penalty_weight_(kind == CostKind::kUcb ? 1.0 : 0.0),
      vertex_weight_(kind == CostKind::kVertices ? 1.0 : 0.0),
      alpha_per_m_(kind == CostKind::kEuclidean ? 1.0 : alpha_per_m),
      resolution_m_(information.penalty.geometry().resolution_m),
      lower_bound_per_m_(alpha_per_m_ + penalty_weight_ *
                                            static_cast<double>(information.min_penalty) /
                                            resolution_m_),
      lower_bound_per_edge_(vertex_weight_ * static_cast<double>(information.min_penalty)) {}

double EdgeCost::operator()(Point2 a, Point2 b) const { return UpTo(a, b, kInfinity); }

double EdgeCost::UpTo(Point2 a, Point2 b, double limit) const {
  // More than rounding takes off sums of prices, so that it decides between equals as if they were
  // summed to the end.
  constexpr double kRounding = 1.0 + 1e-9;
  const double length_price = alpha_per_m_ > 0.0 ? alpha_per_m_ * Distance_m(a, b) : 0.0;
  const double most_cells =
      penalty_weight_ > 0.0 ? (limit * kRounding - length_price) / penalty_weight_ : kInfinity;
  const double penalty_cells = SegmentIntegralUpTo_cells(information_->penalty, a, b, most_cells);
  if (penalty_cells == kInfinity) return kInfinity;
  if (vertex_weight_ > 0.0) {
    return static_cast<double>(information_->penalty[geometry().CellAt(b)]) + length_price;
  }
  return penalty_weight_ * penalty_cells + length_price;
}

double EdgeCost::InformedHeuristic(Point2 a, Point2 b) const {
  constexpr double kGreatestPenalty = 1.0;
  double price = alpha_per_m_ * Distance_m(a, b);
  if (penalty_weight_ > 0.0) {
    price += OpenSegmentIntegral_cells(information_->penalty, a, b, kGreatestPenalty);
  }
  return price;
}

double PathCost(const EdgeCost& cost, const std::vector<Point2>& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += cost(path[i - 1], path[i]);
  return sum;
}

}  // namespace plumescout
