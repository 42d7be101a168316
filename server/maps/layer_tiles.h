// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/slice.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "plumescout/v1/map_service.pb.h"
#include "proto/convert/raster.h"

namespace plumescout::server {

inline constexpr int kTileSquares = 64;  // along a tile's side

// One layer of a map in a form that readers may ask for.
struct LayerForm {
  v1::MapLayer layer = v1::MAP_LAYER_OCCUPANCY;
  bool full_precision = false;  // of gas
  int level_of_detail = 0;
  std::string species = {};  // of gas: as in v1::MapTile

  friend auto operator<=>(const LayerForm&, const LayerForm&) = default;
};

// A raster, and the revision at which it took the place of another.
template <typename T>
struct DatedRaster {
  std::shared_ptr<const Grid<T>> raster;
  std::int64_t since = 0;
};

// Of a gas beside the first.
struct GasRasters {
  std::string species;
  DatedRaster<float> mean_ppm;
  DatedRaster<float> variance_ppm2;
};

// The rasters of a map at one revision. All have the geometry of `occupancy`.
struct MapRasters {
  std::int64_t revision = 0;
  DatedRaster<CellState> occupancy;
  DatedRaster<float> gas_mean_ppm;
  DatedRaster<float> gas_variance_ppm2;
  std::vector<GasRasters> further_gases;
};

// A v1::MapTile, encoded once for all revisions in which its cells are the same.
struct StoredTile {
  std::int64_t since = 0;  // the revision at which the cells were first found to be so
  grpc::Slice bytes;       // empty: nothing is known of any of its squares
};

// The tiles of one layer in one form, encoded when somebody asks for them, and anew only if their
// cells have changed. Cells are compared by a hash of 64 bits, so that no old raster has to be
// kept. Not thread-safe.
class LayerTiles {
 public:
  LayerTiles(const LayerForm& form, const GridGeometry& cells);

  const LayerForm& form() const { return form_; }
  const GridGeometry& squares() const { return squares_; }
  // The tiles' numbers along the two axes begin at 0.
  int column_count() const { return column_count_; }
  int row_count() const { return row_count_; }
  CellRect RectOf(Cell tile) const;  // in squares

  // REQUIRES: rasters of the geometry given, of a revision not before that of the last call.
  const StoredTile& At(Cell tile, const MapRasters& rasters);
  std::int64_t encoded_count() const { return encoded_count_; }

 private:
  struct Slot {
    std::int64_t checked = -1;  // the latest revision at which the tile was looked at
    std::size_t hash = 0;       // of its cells then
    StoredTile tile;
  };

  grpc::Slice Encode(const CellRect& rect, const MapRasters& rasters);

  const LayerForm form_;
  const GridGeometry squares_;
  const int column_count_;
  const int row_count_;
  std::vector<Slot> slots_;
  std::int64_t encoded_count_ = 0;
};

// A tile of which nothing is known, for a reader who holds another in its place.
grpc::Slice UnknownTile(const LayerForm& form, const CellRect& rect);

}  // namespace plumescout::server
