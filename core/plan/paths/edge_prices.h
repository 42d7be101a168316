// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/plan/cost/edge_cost.h"
#include "core/types/pose2.h"

namespace plumescout {

// An edge cost that remembers: what straightens ways asks for the price of an edge again and again,
// and ways out of one tree begin alike. Refers to the cost.
class EdgePrices {
 public:
  explicit EdgePrices(const EdgeCost& cost) : cost_(cost), kept_(kMostKept) {}

  const EdgeCost& cost() const { return cost_; }

  // EdgeCost::UpTo, but it may be the price where that is `limit` or more.
  double UpTo(Point2 a, Point2 b, double limit);

 private:
  // The latest of some edges: its price, or infinity, and it is `limit` or more.
  struct Kept {
    Point2 a;
    Point2 b;
    double price = std::numeric_limits<double>::infinity();
    double limit = -std::numeric_limits<double>::infinity();
  };
  static constexpr std::size_t kMostKept = 2048;  // a power of two

  static std::size_t PlaceOf(Point2 a, Point2 b);

  const EdgeCost& cost_;
  std::vector<Kept> kept_;
};

}  // namespace plumescout
