// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/layer_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "absl/hash/hash.h"
#include "absl/strings/string_view.h"
#include "proto/convert/geometry.h"
#include "server/maps/level_of_detail.h"
#include "server/maps/wire_message.h"

namespace plumescout::server {
namespace {

int TilesAlong(int squares) { return (squares + kTileSquares - 1) / kTileSquares; }

// REQUIRES: a gas layer, of a gas that there is.
const DatedRaster<float>& GasOf(const MapRasters& rasters, const LayerForm& form) {
  const bool is_mean = form.layer == v1::MAP_LAYER_GAS_MEAN;
  for (const GasRasters& gas : rasters.further_gases) {
    if (gas.species == form.species) return is_mean ? gas.mean_ppm : gas.variance_ppm2;
  }
  return is_mean ? rasters.gas_mean_ppm : rasters.gas_variance_ppm2;
}

// Bytes, not values: a NaN that stays is no change.
template <typename T>
std::size_t HashOf(const Grid<T>& cells, const CellRect& rect) {
  std::size_t hash = 0;
  for (int row = 0; row < rect.height(); ++row) {
    const T* first = &cells[Cell{rect.min.x, rect.min.y + row}];
    hash =
        absl::HashOf(hash, absl::string_view(reinterpret_cast<const char*>(first),
                                             static_cast<std::size_t>(rect.width()) * sizeof(T)));
  }
  return hash;
}

grpc::Slice Place(v1::MapTile tile, Cell min) {
  *tile.mutable_min_cell() = ToProto(min);
  return Serialise(tile);
}

v1::MapTile EncodeValues(const LayerForm& form, const Grid<float>& values) {
  const CellRect all = WholeRaster(values.geometry());
  v1::MapTile tile = form.full_precision ? EncodeFloats(form.layer, values, all)
                                         : EncodeScaled(form.layer, values, all);
  tile.set_species(form.species);
  return tile;
}

bool SameBytes(const grpc::Slice& a, const grpc::Slice& b) {
  return a.size() == b.size() && std::memcmp(a.begin(), b.begin(), a.size()) == 0;
}

template <typename T, typename IsUnknown>
bool AllOf(const Grid<T>& squares, IsUnknown is_unknown) {
  return std::all_of(squares.values().begin(), squares.values().end(), is_unknown);
}

}  // namespace

LayerTiles::LayerTiles(const LayerForm& form, const GridGeometry& cells)
    : form_(form),
      squares_(SquaresOf(cells, form.level_of_detail)),
      column_count_(TilesAlong(squares_.width)),
      row_count_(TilesAlong(squares_.height)),
      slots_(static_cast<std::size_t>(column_count_) * static_cast<std::size_t>(row_count_)) {}

CellRect LayerTiles::RectOf(Cell tile) const {
  const Cell min{tile.x * kTileSquares, tile.y * kTileSquares};
  return CellRect::Sized(min, kTileSquares, kTileSquares).Within(WholeRaster(squares_));
}

const StoredTile& LayerTiles::At(Cell tile, const MapRasters& rasters) {
  Slot& slot = slots_[static_cast<std::size_t>(tile.y) * static_cast<std::size_t>(column_count_) +
                      static_cast<std::size_t>(tile.x)];
  const bool is_gas = form_.layer != v1::MAP_LAYER_OCCUPANCY;
  const std::int64_t raster_since = is_gas ? GasOf(rasters, form_).since : rasters.occupancy.since;
  if (slot.checked >= raster_since) return slot.tile;
  const CellRect rect = RectOf(tile);
  const CellRect cells = CellsOf(rect, form_.level_of_detail, rasters.occupancy.raster->geometry());
  const std::size_t hash = is_gas ? HashOf(*GasOf(rasters, form_).raster, cells)
                                  : HashOf(*rasters.occupancy.raster, cells);
  const bool is_new = slot.checked < 0;
  slot.checked = rasters.revision;
  if (!is_new && hash == slot.hash) return slot.tile;
  slot.hash = hash;
  grpc::Slice bytes = Encode(rect, rasters);
  if (is_new || !SameBytes(bytes, slot.tile.bytes)) slot.tile = {rasters.revision, bytes};
  return slot.tile;
}

grpc::Slice LayerTiles::Encode(const CellRect& rect, const MapRasters& rasters) {
  ++encoded_count_;
  if (form_.layer == v1::MAP_LAYER_OCCUPANCY) {
    const auto states = WorstStates(*rasters.occupancy.raster, form_.level_of_detail, rect);
    if (AllOf(states, [](CellState state) { return state == CellState::kUnknown; })) return {};
    return Place(EncodeStates(states, WholeRaster(states.geometry())), rect.min);
  }
  const auto values = LargestValues(*GasOf(rasters, form_).raster, form_.level_of_detail, rect);
  if (AllOf(values, [](float value) { return std::isnan(value); })) return {};
  return Place(EncodeValues(form_, values), rect.min);
}

grpc::Slice UnknownTile(const LayerForm& form, const CellRect& rect) {
  const GridGeometry geometry{0.0, 0.0, 1.0, rect.width(), rect.height()};
  if (form.layer == v1::MAP_LAYER_OCCUPANCY) {
    const Grid<CellState> unknown(geometry, CellState::kUnknown);
    return Place(EncodeStates(unknown, WholeRaster(geometry)), rect.min);
  }
  const Grid<float> nothing(geometry, std::numeric_limits<float>::quiet_NaN());
  return Place(EncodeValues(form, nothing), rect.min);
}

}  // namespace plumescout::server
