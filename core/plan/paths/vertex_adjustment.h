// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/paths/edge_prices.h"
#include "core/plan/paths/shortcut.h"
#include "core/types/stop.h"

namespace plumescout {

// Moves the vertices of a polyline, all but the first and the last, one by one to centres of cells
// near by, as long as that makes it cheaper: straight runs then need not end at cells that the
// search happened to cross. Steps of four cells come first, then shorter ones. What `stop` leaves
// undone stays as it was. `path.cost` is that of its vertices, before and after; `edges_evaluated`
// is added to. Cost: some hundreds of edge integrals a vertex.
void AdjustVertices(EdgePrices& prices, const StopFn& stop, ShortcutPath& path);

}  // namespace plumescout
