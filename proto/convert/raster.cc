// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/raster.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/zlib_codec.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"

namespace plumescout {
namespace {

static_assert(std::endian::native == std::endian::little, "rasters travel as little-endian bytes");

constexpr std::uint16_t kNanCount = 65535;
constexpr double kSteps = kNanCount - 1;

template <typename T>
std::string Deflate(const std::vector<T>& cells, int level = kFastDeflate) {
  return CompressZlib({reinterpret_cast<const char*>(cells.data()), cells.size() * sizeof(T)},
                      level);
}

// The rectangle's cells, row by row, as one vector.
template <typename T>
std::vector<T> Gather(const Grid<T>& grid, const CellRect& rect) {
  std::vector<T> cells;
  cells.reserve(rect.size());
  for (int row = 0; row < rect.height(); ++row) {
    if (rect.width() == 0) break;
    const T* first = &grid[Cell{rect.min.x, rect.min.y + row}];
    cells.insert(cells.end(), first, first + rect.width());
  }
  return cells;
}

template <typename T>
void Scatter(const std::vector<T>& cells, const CellRect& rect, Grid<T>& grid) {
  for (int row = 0; row < rect.height(); ++row) {
    const auto first = cells.begin() + static_cast<std::ptrdiff_t>(row) * rect.width();
    for (int column = 0; column < rect.width(); ++column) {
      grid[Cell{rect.min.x + column, rect.min.y + row}] = first[column];
    }
  }
}

v1::MapTile MakeTile(v1::MapLayer layer, const CellRect& rect, v1::MapTile::Encoding encoding) {
  v1::MapTile tile;
  tile.set_layer(layer);
  *tile.mutable_min_cell() = ToProto(rect.min);
  tile.set_column_count(rect.width());
  tile.set_row_count(rect.height());
  tile.set_encoding(encoding);
  return tile;
}

absl::StatusOr<CellRect> ReadRect(const v1::MapTile& tile, absl::string_view field,
                                  const GridGeometry& geometry) {
  const Cell min = FromProto(tile.min_cell());
  const std::string cell = Join(field, "min_cell");
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange(Join(cell, "column"), min.x, 0, geometry.width));
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange(Join(cell, "row"), min.y, 0, geometry.height));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange(Join(field, "column_count"), tile.column_count(), 0, geometry.width - min.x));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange(Join(field, "row_count"), tile.row_count(), 0, geometry.height - min.y));
  return CellRect::Sized(min, tile.column_count(), tile.row_count());
}

template <typename T>
absl::StatusOr<std::vector<T>> InflateCells(const v1::MapTile& tile, absl::string_view field,
                                            const CellRect& rect) {
  std::vector<T> cells(rect.size());
  const std::size_t size = cells.size() * sizeof(T);
  const absl::StatusOr<std::string> bytes = DecompressZlib(tile.deflated_data(), size);
  if (!bytes.ok() || bytes->size() != size) {
    return FieldError(Join(field, "deflated_data"),
                      absl::StrCat("must inflate to exactly ", size, " bytes"));
  }
  if (size > 0) std::memcpy(cells.data(), bytes->data(), size);
  return cells;
}

absl::StatusOr<std::vector<float>> ReadScaled(const v1::MapTile& tile, absl::string_view field,
                                              const CellRect& rect) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(Join(field, "value_scale"), tile.value_scale()));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFinite(Join(field, "value_offset"), tile.value_offset()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto counts, InflateCells<std::uint16_t>(tile, field, rect));
  std::vector<float> values;
  values.reserve(counts.size());
  for (const std::uint16_t count : counts) {
    values.push_back(count == kNanCount
                         ? std::numeric_limits<float>::quiet_NaN()
                         : static_cast<float>(tile.value_offset() + tile.value_scale() * count));
  }
  return values;
}

}  // namespace

v1::MapTile EncodeStates(const Grid<CellState>& states, const CellRect& rect, int deflate_level) {
  v1::MapTile tile = MakeTile(v1::MAP_LAYER_OCCUPANCY, rect, v1::MapTile::ENCODING_U8);
  static_assert(sizeof(CellState) == 1);
  const std::vector<CellState> cells = Gather(states, rect);
  tile.set_deflated_data(Deflate(cells, deflate_level));
  return tile;
}

v1::MapTile EncodeScaled(v1::MapLayer layer, const Grid<float>& values, const CellRect& rect) {
  const std::vector<float> cells = Gather(values, rect);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const float value : cells) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, static_cast<double>(value));
    high = std::max(high, static_cast<double>(value));
  }
  v1::MapTile tile = MakeTile(layer, rect, v1::MapTile::ENCODING_U16_SCALED);
  const double scale = high > low ? (high - low) / kSteps : 0.0;
  tile.set_value_scale(scale);
  tile.set_value_offset(high >= low ? low : 0.0);
  std::vector<std::uint16_t> counts;
  counts.reserve(cells.size());
  for (const float value : cells) {
    const double step = scale > 0.0 ? std::round((value - low) / scale) : 0.0;
    counts.push_back(std::isfinite(value) ? static_cast<std::uint16_t>(step) : kNanCount);
  }
  tile.set_deflated_data(Deflate(counts));
  return tile;
}

v1::MapTile EncodeFloats(v1::MapLayer layer, const Grid<float>& values, const CellRect& rect) {
  v1::MapTile tile = MakeTile(layer, rect, v1::MapTile::ENCODING_F32);
  const std::vector<float> cells = Gather(values, rect);
  tile.set_deflated_data(Deflate(cells));
  return tile;
}

absl::Status DecodeStates(const v1::MapTile& tile, absl::string_view field,
                          Grid<CellState>& states) {
  if (tile.encoding() != v1::MapTile::ENCODING_U8) {
    return FieldError(Join(field, "encoding"), tile.encoding(), "must be ENCODING_U8");
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const CellRect rect, ReadRect(tile, field, states.geometry()));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto cells, InflateCells<CellState>(tile, field, rect));
  for (const CellState state : cells) {
    if (state > CellState::kOccupied) {
      return FieldError(Join(field, "deflated_data"), static_cast<double>(state),
                        "is not a cell state");
    }
  }
  Scatter(cells, rect, states);
  return absl::OkStatus();
}

absl::Status DecodeValues(const v1::MapTile& tile, absl::string_view field, Grid<float>& values) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const CellRect rect, ReadRect(tile, field, values.geometry()));
  std::vector<float> cells;
  if (tile.encoding() == v1::MapTile::ENCODING_U16_SCALED) {
    PLUMESCOUT_ASSIGN_OR_RETURN(cells, ReadScaled(tile, field, rect));
  } else if (tile.encoding() == v1::MapTile::ENCODING_F32) {
    PLUMESCOUT_ASSIGN_OR_RETURN(cells, InflateCells<float>(tile, field, rect));
  } else {
    return FieldError(Join(field, "encoding"), tile.encoding(),
                      "must be ENCODING_F32 or ENCODING_U16_SCALED");
  }
  Scatter(cells, rect, values);
  return absl::OkStatus();
}

}  // namespace plumescout
