// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/neighbour_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumescout {
namespace {

// Few points over a wide area need no more buckets than this on either axis.
constexpr double kMaxBuckets = 1000.0;

int BucketOf(double offset_m, double width_m, int buckets) {
  return std::clamp(static_cast<int>(offset_m / width_m), 0, buckets - 1);
}

}  // namespace

NeighbourIndex::NeighbourIndex(const std::vector<Point2>& points, double radius_m)
    : radius_m_(radius_m), width_m_(radius_m) {
  if (!points.empty()) origin_ = points.front();
  Point2 top = origin_;
  for (const Point2 p : points) {
    origin_ = {std::min(origin_.x_m, p.x_m), std::min(origin_.y_m, p.y_m)};
    top = {std::max(top.x_m, p.x_m), std::max(top.y_m, p.y_m)};
  }
  const double extent_m = std::max(top.x_m - origin_.x_m, top.y_m - origin_.y_m);
  width_m_ = std::max(radius_m, extent_m / kMaxBuckets);
  columns_ = 1 + static_cast<int>((top.x_m - origin_.x_m) / width_m_);
  rows_ = 1 + static_cast<int>((top.y_m - origin_.y_m) / width_m_);

  const auto bucket_of = [this](Point2 p) {
    return static_cast<std::size_t>(BucketY(p.y_m) * columns_ + BucketX(p.x_m));
  };
  first_of_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const Point2 p : points) ++first_of_[bucket_of(p) + 1];
  std::partial_sum(first_of_.begin(), first_of_.end(), first_of_.begin());
  std::vector<std::size_t> next(first_of_.begin(), first_of_.end() - 1);
  entries_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    entries_[next[bucket_of(points[i])]++] = {points[i], static_cast<int>(i)};
  }
}

int NeighbourIndex::BucketX(double x_m) const {
  return BucketOf(x_m - origin_.x_m, width_m_, columns_);
}
int NeighbourIndex::BucketY(double y_m) const {
  return BucketOf(y_m - origin_.y_m, width_m_, rows_);
}

}  // namespace plumescout
