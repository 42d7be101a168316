// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/plan/cost/information_map.h"
#include "core/types/grid.h"
#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

// Integral of `raster` along the straight segment a-b (frame map) in units of cells: the sum over
// the cells crossed of its value times the length inside the cell over the cell's edge.
// This is our reading of the sum over S(x, y) in [XIT] Eq. (12): it is exact, adds up when a
// segment is split and is the same both ways. +infinity if any cell that WalkSegment visits has an
// infinite value or lies outside the raster; so no path slips between two blocked cells that meet
// at a corner. Cost: O(cells crossed).
double SegmentIntegral_cells(const Grid<float>& raster, Point2 a, Point2 b);

// The same over the cells that can be crossed: others count as `blocked_value`.
double OpenSegmentIntegral_cells(const Grid<float>& raster, Point2 a, Point2 b,
                                 double blocked_value);

// A point, and the cell of the raster that holds it.
struct PointInCell {
  Point2 point;
  Cell cell;
};

// Price of driving a straight segment, [XIT] Eq. (12): information penalty, in cells, plus alpha
// per metre. kVertices takes the penalty of the cell that the segment ends in and of no other (the
// paper's alternative; not the same both ways). kEuclidean is P = 0 and alpha = 1: the length.
// +infinity if any cell touched is not traversable. Cheap to copy; keeps a reference to the map.
class EdgeCost {
 public:
  EdgeCost(const InformationMap& information, CostKind kind, double alpha_per_m);

  // c(a, b) of Eq. (12).
  double operator()(Point2 a, Point2 b) const;

  // The same if it is less than `limit`; else that or more, maybe +infinity. Those who look for
  // something cheaper need not know how much dearer it is.
  double UpTo(Point2 a, Point2 b, double limit) const;
  double UpTo(const PointInCell& a, const PointInCell& b, double limit) const;

  // The same where the penalty of the segment, SegmentIntegral_cells, is known.
  double OfPenalty(double penalty_cells, Point2 a, Point2 b) const;

  // c-hat of [XIT] Eq. (6): no segment of this length, > 0, costs less.
  double LowerBound(double length_m) const {
    return lower_bound_per_edge_ + lower_bound_per_m_ * length_m;
  }

  // h-hat of [XIT] Alg. 1 line 13 towards a goal at this distance: distance only, consistent.
  double Heuristic(double distance_m) const { return alpha_per_m_ * distance_m; }
  bool HasHeuristic() const { return alpha_per_m_ > 0.0; }

  // The other h-hat of [XIT] section IV-C: the price of the straight segment as if what stands in
  // the way had the greatest penalty. May exceed the price of the best way round.
  double InformedHeuristic(Point2 a, Point2 b) const;

  // The price of one grid step of `length_cells` between the centres of neighbouring cells, half
  // in each: the same integral, without the walk.
  double GridStep(float penalty_from, float penalty_to, double length_cells) const {
    constexpr double kHalf = 0.5;
    const double penalty = kHalf * (static_cast<double>(penalty_from) + penalty_to);
    return (penalty_weight_ * penalty + alpha_per_m_ * resolution_m_) * length_cells +
           vertex_weight_ * static_cast<double>(penalty_to);
  }

  // Whether what lies between vertices is free (kVertices): fewer of them are then always cheaper.
  bool CountsVerticesOnly() const { return vertex_weight_ > 0.0; }

  const InformationMap& information() const { return *information_; }
  const GridGeometry& geometry() const { return information_->penalty.geometry(); }

 private:
  double LengthPrice(Point2 a, Point2 b) const {
    return alpha_per_m_ > 0.0 ? alpha_per_m_ * Distance_m(a, b) : 0.0;
  }

  const InformationMap* information_;
  double penalty_weight_;  // of the integral: 1 for kUcb, else 0
  double vertex_weight_;   // of the end: 1 for kVertices, else 0
  double alpha_per_m_;
  double resolution_m_;
  double lower_bound_per_m_;
  double lower_bound_per_edge_;
};

// J of [XIT] Eq. (13): the sum over the segments of a polyline.
double PathCost(const EdgeCost& cost, const std::vector<Point2>& path);

}  // namespace plumescout
