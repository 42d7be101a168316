// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/plan/paths/edge_prices.h"
#include "core/types/pose2.h"
#include "core/types/stop.h"

namespace plumescout {

// `path` without the vertices in the middle of straight runs. The first and last stay.
std::vector<Point2> WithoutCollinear(const std::vector<Point2>& path);

struct ShortcutPath {
  std::vector<Point2> vertices;
  double cost = 0.0;
  int edges_evaluated = 0;
};

// The cheapest polyline through some of the vertices of `path` in their order, first and last
// included, that skips at most kShortcutWindow - 1 vertices at a time; never dearer than `path`.
// When `stop` says so the rest of the path is taken as it is.
// REQUIRES: at least one vertex. Cost: O(vertices * kShortcutWindow) edge integrals.
inline constexpr int kShortcutWindow = 24;
ShortcutPath Shortcut(EdgePrices& prices, const std::vector<Point2>& path, const StopFn& stop);

}  // namespace plumescout
