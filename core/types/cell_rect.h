// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>

#include "core/types/cell.h"

namespace plumescout {

// Cells [min, min + (width, height)) of a raster.
struct CellRect {
  Cell min;
  int width = 0;
  int height = 0;

  friend auto operator<=>(const CellRect&, const CellRect&) = default;
};

}  // namespace plumescout
