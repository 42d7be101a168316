// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/shortcut.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace plumescout {
namespace {

// Sine of the angle below which two runs count as one; far below that between any two directions
// from cell to cell on a map of 10^4 cells.
constexpr double kCollinear = 1e-9;

bool Straight(Point2 a, Point2 b, Point2 c) {
  const double abx = b.x_m - a.x_m;
  const double aby = b.y_m - a.y_m;
  const double bcx = c.x_m - b.x_m;
  const double bcy = c.y_m - b.y_m;
  const double scale = std::hypot(abx, aby) * std::hypot(bcx, bcy);
  return std::abs(abx * bcy - aby * bcx) <= kCollinear * scale && abx * bcx + aby * bcy >= 0.0;
}

}  // namespace

std::vector<Point2> WithoutCollinear(const std::vector<Point2>& path) {
  std::vector<Point2> kept;
  for (const Point2 point : path) {
    if (kept.size() >= 2 && Straight(kept[kept.size() - 2], kept.back(), point)) kept.pop_back();
    kept.push_back(point);
  }
  return kept;
}

ShortcutPath Shortcut(EdgePrices& prices, const std::vector<Point2>& path, const StopFn& stop) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ShortcutPath result;
  std::vector<double> best(path.size(), kInfinity);
  std::vector<std::size_t> previous(path.size(), 0);
  best[0] = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const std::size_t window = stop() ? 1 : std::min<std::size_t>(i, kShortcutWindow);
    for (std::size_t j = i; j-- > i - window;) {
      if (best[j] + prices.cost().LowerBound(Distance_m(path[j], path[i])) >= best[i]) continue;
      ++result.edges_evaluated;
      const double via_j = best[j] + prices.UpTo(path[j], path[i], best[i] - best[j]);
      if (via_j < best[i]) {
        best[i] = via_j;
        previous[i] = j;
      }
    }
  }
  result.cost = best.back();
  for (std::size_t i = path.size() - 1; i > 0; i = previous[i]) {
    result.vertices.push_back(path[i]);
  }
  result.vertices.push_back(path.front());
  std::reverse(result.vertices.begin(), result.vertices.end());
  return result;
}

}  // namespace plumescout
