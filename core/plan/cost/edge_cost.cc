// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/edge_cost.h"

#include <limits>

#include "core/grid/ray.h"

namespace plumescout {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// SegmentIntegral_cells, but may stop and return +infinity once the sum is over `most_cells`.
[[gnu::flatten]] double IntegralUpTo_cells(const Grid<float>& raster, const PointInCell& a,
                                           const PointInCell& b, double most_cells) {
  // Between two cells of the raster the walk never leaves it.
  if (!raster.Contains(a.cell) || !raster.Contains(b.cell)) return kInfinity;
  double sum = 0.0;
  const auto add = [&](Cell cell, double length_cells) {
    const double value = raster[cell];
    if (value == kInfinity) return false;
    sum += value * length_cells;
    return sum <= most_cells;
  };
  return WalkSegment(raster.geometry(), a.point, a.cell, b.point, b.cell, add) ? sum : kInfinity;
}

}  // namespace

double SegmentIntegral_cells(const Grid<float>& raster, Point2 a, Point2 b) {
  const GridGeometry& geometry = raster.geometry();
  return IntegralUpTo_cells(raster, {a, geometry.CellAt(a)}, {b, geometry.CellAt(b)}, kInfinity);
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
  return UpTo({a, geometry().CellAt(a)}, {b, geometry().CellAt(b)}, limit);
}

double EdgeCost::UpTo(const PointInCell& a, const PointInCell& b, double limit) const {
  // More than rounding takes off sums of prices, so that it decides between equals as if they were
  // summed to the end.
  constexpr double kRounding = 1.0 + 1e-9;
  const double most_cells =
      penalty_weight_ > 0.0 ? (limit * kRounding - LengthPrice(a.point, b.point)) / penalty_weight_
                            : kInfinity;
  return OfPenalty(IntegralUpTo_cells(information_->penalty, a, b, most_cells), a.point, b.point);
}

double EdgeCost::OfPenalty(double penalty_cells, Point2 a, Point2 b) const {
  if (penalty_cells == kInfinity) return kInfinity;
  if (vertex_weight_ > 0.0) {
    return static_cast<double>(information_->penalty[geometry().CellAt(b)]) + LengthPrice(a, b);
  }
  return penalty_weight_ * penalty_cells + LengthPrice(a, b);
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
