// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "core/types/cell_rect.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "plumescout/v1/map_service.pb.h"

namespace plumescout {

inline constexpr int kFastDeflate = 1;   // of maps that change: they are mostly runs
inline constexpr int kDenseDeflate = 6;  // of maps that are packed once

// One rectangle of one layer, deflated. Scaled tiles map the finite values of the rectangle onto
// 65535 steps, so a cell is off by at most half of one; NaN stays NaN.
// REQUIRES: the rectangle lies in the raster.
v1::MapTile EncodeStates(const Grid<CellState>& states, const CellRect& rect,
                         int deflate_level = kFastDeflate);
v1::MapTile EncodeScaled(v1::MapLayer layer, const Grid<float>& values, const CellRect& rect);
v1::MapTile EncodeFloats(v1::MapLayer layer, const Grid<float>& values, const CellRect& rect);

// Writes a tile into a raster. kInvalidArgument, with the raster unchanged, if it reaches beyond
// the raster, its data do not inflate to exactly its cells, or a value is unknown. Inflating stops
// at the size expected: no tile can ask for more memory than its rectangle.
absl::Status DecodeStates(const v1::MapTile& tile, absl::string_view field,
                          Grid<CellState>& states);
absl::Status DecodeValues(const v1::MapTile& tile, absl::string_view field, Grid<float>& values);

}  // namespace plumescout
