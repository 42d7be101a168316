// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/types/pose2.h"

namespace plumescout {

// Points in square buckets as wide as the search radius: near points lie in nine buckets.
class NeighbourIndex {
 public:
  // REQUIRES: radius_m > 0, finite points. Cost: O(points + buckets).
  NeighbourIndex(const std::vector<Point2>& points, double radius_m);

  // Calls visit(index, distance_m) for every point within the radius of `center`, at distance 0
  // too. In a fixed order. Cost: O(points in nine buckets).
  template <typename Visit>
  void ForEachNear(Point2 center, Visit&& visit) const {
    const int bx = BucketX(center.x_m);
    const int by = BucketY(center.y_m);
    for (int y = by > 0 ? by - 1 : 0; y <= by + 1 && y < rows_; ++y) {
      // Buckets of one row follow each other, and so do their points.
      const int row = y * columns_;
      const std::size_t first = FirstOf(row + (bx > 0 ? bx - 1 : 0));
      const std::size_t last = FirstOf(row + (bx + 2 < columns_ ? bx + 2 : columns_));
      for (std::size_t i = first; i < last; ++i) {
        const Entry& entry = entries_[i];
        const double dx = entry.at.x_m - center.x_m;
        const double dy = entry.at.y_m - center.y_m;
        const double squared_m2 = dx * dx + dy * dy;
        if (squared_m2 <= radius_m_ * radius_m_) visit(entry.index, std::sqrt(squared_m2));
      }
    }
  }

 private:
  struct Entry {
    Point2 at;
    int index;
  };

  int BucketX(double x_m) const;
  int BucketY(double y_m) const;
  std::size_t FirstOf(int bucket) const { return first_of_[static_cast<std::size_t>(bucket)]; }

  double radius_m_;
  double width_m_;  // of a bucket, at least the radius
  Point2 origin_;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<Entry> entries_;         // by bucket, then by index
  std::vector<std::size_t> first_of_;  // of each bucket in entries_, and the end
};

}  // namespace plumescout
