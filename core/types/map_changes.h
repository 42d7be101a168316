// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "core/types/cell_rect.h"

namespace plumescout {

// How the rasters of a map differ from those that a reader had before.
struct MapChanges {
  bool everything = false;        // the map was replaced; its geometry may be another
  std::set<CellRect> rects = {};  // else: squares that may differ, in some layer

  friend bool operator==(const MapChanges&, const MapChanges&) = default;
};

}  // namespace plumescout
