// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace plumescout {

// The value that `share` of the values lie below, linear between order statistics: 0 gives the
// least, 1 the greatest, 0.5 the median. NaN of none. Cost: O(values). REQUIRES: share in [0, 1],
// no NaN among the values.
template <typename T>
double Quantile(std::vector<T> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), below, values.end());
  const auto low = static_cast<double>(*below);
  if (below + 1 == values.end()) return low;
  const auto high = static_cast<double>(*std::min_element(below + 1, values.end()));
  return low + (rank - std::floor(rank)) * (high - low);
}

template <typename T>
double Median(std::vector<T> values) {
  constexpr double kHalf = 0.5;
  return Quantile(std::move(values), kHalf);
}

}  // namespace plumescout
