// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/types/cell.h"
#include "core/types/cell_rect.h"
#include "core/types/grid_geometry.h"

namespace plumescout {

// Where the raster of a gas field lies on the map: that may have grown since the field was
// computed, and never becomes smaller.
class FieldWindow {
 public:
  // REQUIRES: `map` covers `field`, by whole cells.
  FieldWindow(const GridGeometry& map, const GridGeometry& field)
      : field_(field), corner_(map.CellAt(field.Center({0, 0}))) {}

  // The cell of the map as one of the field; none if the field has it not.
  std::optional<Cell> InField(Cell cell) const {
    const Cell inside{cell.x - corner_.x, cell.y - corner_.y};
    return field_.Contains(inside) ? std::optional<Cell>(inside) : std::nullopt;
  }

  // Cells of the field as some of the map.
  CellRect InMap(const CellRect& inside) const {
    return {{inside.min.x + corner_.x, inside.min.y + corner_.y},
            {inside.end.x + corner_.x, inside.end.y + corner_.y}};
  }

 private:
  GridGeometry field_;
  Cell corner_;
};

}  // namespace plumescout
