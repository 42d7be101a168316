// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/map_store.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"
#include "core/types/species.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "server/maps/level_of_detail.h"
#include "server/maps/part_token.h"
#include "server/maps/wire_message.h"

namespace plumescout::server {
namespace {

// Views and steps of one revision that are shared; who comes with more of them pays for his own.
constexpr std::size_t kMaxShared = 16;
// Maps that are kept for their readers in parts, and what they may take together if they are more
// than one.
constexpr std::size_t kMaxKept = 8;
constexpr std::size_t kMaxKept_bytes = std::size_t{4} << 20;

template <typename T>
void Renew(const std::shared_ptr<const Grid<T>>& raster, std::int64_t revision,
           DatedRaster<T>& dated) {
  if (dated.raster != raster) dated = {raster, revision};
}

template <typename T>
void Share(T item, std::deque<T>& items) {
  items.push_back(std::move(item));
  if (items.size() > kMaxShared) items.pop_front();
}

std::int64_t AuditsOf(const Belief& belief) {
  std::int64_t audits = belief.gas_audits.audits;
  for (const GasField& gas : belief.further_gases) audits += gas.audits.audits;
  return audits;
}

// The gases that a view is of, as tiles name them: the first is not named.
std::vector<std::string> SpeciesOf(const MapView& view, const MapRasters& rasters) {
  if (view.species.empty()) return {""};
  std::vector<std::string> species;
  for (const std::string& name : view.species) {
    const bool is_further = std::any_of(rasters.further_gases.begin(), rasters.further_gases.end(),
                                        [&](const GasRasters& gas) { return gas.species == name; });
    species.push_back(is_further ? name : "");
  }
  return species;
}

// Large maps have long frontiers. The geometry and the robots stay whatever they take.
grpc::Slice SerialiseStatus(v1::MapStatus status, std::int64_t max_bytes) {
  const auto room = static_cast<std::size_t>(max_bytes);
  if (status.ByteSizeLong() > room) {
    for (v1::Frontier& frontier : *status.mutable_frontiers()) {
      frontier.clear_cell_columns();
      frontier.clear_cell_rows();
    }
  }
  std::size_t bytes = status.ByteSizeLong();
  while (bytes > room && status.frontiers_size() > 0) {
    bytes -= std::min(bytes, status.frontiers(status.frontiers_size() - 1).ByteSizeLong());
    status.mutable_frontiers()->RemoveLast();
  }
  return Serialise(status);
}

// The tiles of which the view's region holds a point.
CellRect TilesOf(const MapView& view, const LayerTiles& layer) {
  const Cell all{layer.column_count(), layer.row_count()};
  if (!view.region) return {{0, 0}, all};
  const Cell min = layer.squares().CellAt(view.region->min);
  const Cell max = layer.squares().CellAt(view.region->max);
  const auto begin = [](int square) { return std::max(square, 0) / kTileSquares; };
  const auto end = [](int square, int count) {
    return square < 0 ? 0 : std::min(square / kTileSquares + 1, count);
  };
  return {{begin(min.x), begin(min.y)}, {end(max.x, all.x), end(max.y, all.y)}};
}

std::size_t Bytes(const EncodedMap& map) {
  std::size_t bytes = map.status.size();
  for (const EncodedTile& tile : map.tiles) bytes += tile.tile.bytes.size();
  return bytes;
}

}  // namespace

void MapStore::Advance(const Belief& belief) {
  const bool is_later = belief.revision > rasters_.revision ||
                        (belief.revision == rasters_.revision && AuditsOf(belief) > audits_);
  if (has_map_ && !is_later) return;
  if (!has_map_ || rasters_.occupancy.raster->geometry() != belief.geometry()) {
    layers_.clear();
    geometry_since_ = belief.revision;
  }
  has_map_ = true;
  rasters_.revision = belief.revision;
  audits_ = AuditsOf(belief);
  Renew(belief.occupancy, belief.revision, rasters_.occupancy);
  Renew(belief.gas_mean_ppm, belief.revision, rasters_.gas_mean_ppm);
  Renew(belief.Gas(0).published_variance_ppm2(), belief.revision, rasters_.gas_variance_ppm2);
  rasters_.further_gases.resize(belief.further_gases.size());
  for (std::size_t i = 0; i < belief.further_gases.size(); ++i) {
    GasRasters& gas = rasters_.further_gases[i];
    gas.species = SpeciesName(*belief.options, i + 1);
    Renew(belief.further_gases[i].mean_ppm, belief.revision, gas.mean_ppm);
    Renew(belief.further_gases[i].published_variance_ppm2(), belief.revision, gas.variance_ppm2);
  }
  status_ = SerialiseStatus(ToProto(MakeMapStatus(belief), belief.geometry(), mission_),
                            max_part_bytes_ / 2);
  encoded_.clear();
  frames_.clear();
  ++counts_.revisions;
}

void MapStore::AddLayer(const LayerForm& form, EncodedMap& map) {
  LayerTiles& layer =
      layers_.try_emplace(form, form, rasters_.occupancy.raster->geometry()).first->second;
  const std::int64_t encoded_before = layer.encoded_count();
  const CellRect tiles = TilesOf(map.view, layer);
  for (int y = tiles.min.y; y < tiles.end.y; ++y) {
    for (int x = tiles.min.x; x < tiles.end.x; ++x) {
      map.tiles.push_back({form, layer.RectOf({x, y}), layer.At({x, y}, rasters_)});
    }
  }
  counts_.tiles += layer.encoded_count() - encoded_before;
}

MapStore::EncodedPtr MapStore::EncodeNow(const MapView& view) {
  for (const EncodedPtr& map : encoded_) {
    if (map->view == view) return map;
  }
  auto map = std::make_shared<EncodedMap>();
  map->view = view;
  map->revision = rasters_.revision;
  map->geometry_since = geometry_since_;
  map->squares = SquaresOf(rasters_.occupancy.raster->geometry(), view.level_of_detail);
  map->status = status_;
  const int level = view.level_of_detail;
  if (view.occupancy) AddLayer({v1::MAP_LAYER_OCCUPANCY, false, level}, *map);
  for (const std::string& species : SpeciesOf(view, rasters_)) {
    const bool full = view.full_precision;
    if (view.gas_mean) AddLayer({v1::MAP_LAYER_GAS_MEAN, full, level, species}, *map);
    if (view.gas_variance) AddLayer({v1::MAP_LAYER_GAS_VARIANCE, full, level, species}, *map);
  }
  Share(EncodedPtr(map), encoded_);
  return map;
}

MapStore::EncodedPtr MapStore::Encode(const Belief& belief, const MapView& view) {
  absl::MutexLock lock(&mutex_);
  Advance(belief);
  return EncodeNow(view);
}

std::shared_ptr<const MapFrames> MapStore::FramesSince(std::int64_t held, const Belief& belief,
                                                       const MapView& view) {
  absl::MutexLock lock(&mutex_);
  Advance(belief);
  for (const SharedFrames& shared : frames_) {
    if (shared.held == held && shared.map->view == view) return shared.frames;
  }
  EncodedPtr map = EncodeNow(view);
  auto frames = std::make_shared<const MapFrames>(server::FramesSince(held, *map, max_part_bytes_));
  ++counts_.frames;
  Share(SharedFrames{held, std::move(map), frames}, frames_);
  return frames;
}

grpc::ByteBuffer MapStore::FirstPart(const Belief& belief, const MapView& view,
                                     std::int64_t max_bytes) {
  return PartFrom(0, Encode(belief, view), max_bytes);
}

absl::StatusOr<grpc::ByteBuffer> MapStore::NextPart(const std::string& token, const MapView& view,
                                                    std::int64_t max_bytes) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PartPlace place, ReadPartToken(token, mission_, view));
  EncodedPtr map;
  {
    absl::MutexLock lock(&mutex_);
    const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const EncodedPtr& kept) {
      return kept->revision == place.revision && kept->view == view;
    });
    if (found != kept_.end()) map = *found;
  }
  if (map != nullptr && place.tile >= map->tiles.size()) {
    return FieldError("part_token", token, "is not a token of this map");
  }
  if (map == nullptr) {
    return TypedError(absl::StatusCode::kAborted, reason::kMapPartsGone,
                      absl::StrCat("revision ", place.revision,
                                   " of the map is not held any more: begin with its first part"));
  }
  return PartFrom(place.tile, map, max_bytes);
}

grpc::ByteBuffer MapStore::PartFrom(std::size_t tile, const EncodedPtr& map,
                                    std::int64_t max_bytes) {
  const std::int64_t limit = max_bytes > 0 ? std::min(max_bytes, max_part_bytes_) : max_part_bytes_;
  MapPart part = CutPart(*map, tile, limit);
  if (part.end_tile < map->tiles.size()) {
    Keep(map);
    part.head.set_next_part_token(PartToken({map->revision, part.end_tile}, mission_, map->view));
  }
  return Build(*map, part);
}

void MapStore::Keep(const EncodedPtr& map) {
  absl::MutexLock lock(&mutex_);
  std::erase_if(kept_, [&](const EncodedPtr& kept) {
    return kept->revision == map->revision && kept->view == map->view;
  });
  kept_.push_back(map);
  std::size_t bytes = 0;
  for (const EncodedPtr& kept : kept_) bytes += Bytes(*kept);
  while (kept_.size() > 1 && (kept_.size() > kMaxKept || bytes > kMaxKept_bytes)) {
    bytes -= Bytes(*kept_.front());
    kept_.pop_front();
  }
}

MapStoreCounts MapStore::counts() const {
  absl::MutexLock lock(&mutex_);
  return counts_;
}

}  // namespace plumescout::server
