// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/prior_map.h"

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"
#include "proto/convert/raster.h"

namespace plumescout {

v1::PriorMap ToProto(const Grid<CellState>& map) {
  v1::PriorMap proto;
  v1::KnownCells& cells = *proto.mutable_cells();
  *cells.mutable_geometry() = ToProto(map.geometry());
  v1::MapTile tile = EncodeStates(map, WholeRaster(map.geometry()), kDenseDeflate);
  cells.set_deflated_data(std::move(*tile.mutable_deflated_data()));
  return proto;
}

absl::StatusOr<Grid<CellState>> FromProto(const v1::KnownCells& proto, absl::string_view field) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const GridGeometry geometry,
                              FromProto(proto.geometry(), Join(field, "geometry")));
  Grid<CellState> map(geometry);
  v1::MapTile tile;
  tile.set_encoding(v1::MapTile::ENCODING_U8);
  tile.set_column_count(geometry.width);
  tile.set_row_count(geometry.height);
  tile.set_deflated_data(proto.deflated_data());
  PLUMESCOUT_RETURN_IF_ERROR(DecodeStates(tile, field, map));
  return map;
}

}  // namespace plumescout
