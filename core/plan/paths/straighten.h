// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/plan/paths/edge_prices.h"
#include "core/plan/paths/path_planner.h"

namespace plumescout {

// Ours: frees a polyline from the directions of a grid and from detours between samples: Shortcut,
// AdjustVertices, Shortcut again. Never dearer than `way`. Under CostKind::kVertices, where any
// vertex left out is a gain whatever lies between, the way stays as it is. Adds to `effort`; stops
// early, with what it has, when the problem's stop function says so or its edge budget is spent.
// REQUIRES: `prices` are those of the problem; `way` has a vertex and hits nothing. Cost: some
// hundreds of edge integrals a vertex.
FoundPath Straighten(const PathProblem& problem, const std::vector<Point2>& way, PathSource source,
                     EdgePrices& prices, PlanEffort& effort);

}  // namespace plumescout
