// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/edge_prices.h"

#include <bit>
#include <cstdint>

namespace plumescout {

double EdgePrices::UpTo(Point2 a, Point2 b, double limit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Kept& kept = kept_[PlaceOf(a, b)];
  const bool is_known =
      kept.a == a && kept.b == b && (kept.price < kInfinity || limit <= kept.limit);
  if (!is_known) kept = {a, b, cost_.UpTo(a, b, limit), limit};
  return kept.price;
}

std::size_t EdgePrices::PlaceOf(Point2 a, Point2 b) {
  constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15ULL;  // 2^64 over the golden ratio
  constexpr int kShift = 64 - std::countr_zero(kMostKept);
  std::uint64_t hash = 0;
  for (const double coordinate : {a.x_m, a.y_m, b.x_m, b.y_m}) {
    hash = (std::rotl(hash, 31) ^ std::bit_cast<std::uint64_t>(coordinate)) * kFactor;
  }
  return static_cast<std::size_t>(hash >> kShift);
}

}  // namespace plumescout
