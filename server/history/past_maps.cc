// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/past_maps.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/belief/belief.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "server/maps/map_feed.h"
#include "server/maps/map_store.h"
#include "server/maps/part_token.h"

namespace plumescout::server {
namespace {

// Of all missions; and what they may take together if they are more than one.
constexpr std::size_t kMaxPastMaps = 8;
constexpr std::size_t kMaxPastMaps_bytes = std::size_t{16} << 20;

std::size_t BytesOfTiles(const EncodedMap& map) {
  std::size_t bytes = map.status.size();
  for (const EncodedTile& tile : map.tiles) bytes += tile.tile.bytes.size();
  return bytes;
}

}  // namespace

absl::StatusOr<grpc::ByteBuffer> PastMaps::Part(const std::shared_ptr<MissionHost>& host,
                                                const PastMapWish& wish, const StopFn& stop) {
  PartPlace place{wish.revision, 0};
  if (!wish.part_token.empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(place, ReadPartToken(wish.part_token, host->id(), wish.view));
  }
  if (place.revision != wish.revision) {
    return FieldError("part_token", wish.part_token, "is not a token of this revision");
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const EncodedPtr map, Encode(host, wish, stop));
  if (place.tile > 0 && place.tile >= map->tiles.size()) {
    return FieldError("part_token", wish.part_token, "is not a token of this map");
  }
  const std::int64_t most = host->map_feed()->store().max_part_bytes();
  const std::int64_t limit = wish.max_bytes > 0 ? std::min(wish.max_bytes, most) : most;
  MapPart part = CutPart(*map, place.tile, limit);
  if (part.end_tile < map->tiles.size()) {
    part.head.set_next_part_token(PartToken({wish.revision, part.end_tile}, host->id(), wish.view));
  }
  return Build(*map, part);
}

absl::StatusOr<PastMaps::EncodedPtr> PastMaps::Encode(const std::shared_ptr<MissionHost>& host,
                                                      const PastMapWish& wish, const StopFn& stop) {
  if (EncodedPtr found = Find(host, wish)) return found;
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto belief, BeliefAt(host, wish.revision, stop));
  MapStore store(host->id(), host->map_feed()->store().max_part_bytes());
  EncodedPtr map = store.Encode(*belief, wish.view);
  Keep({host, map});
  return map;
}

absl::StatusOr<std::shared_ptr<const Belief>> PastMaps::BeliefAt(
    const std::shared_ptr<MissionHost>& host, std::int64_t revision, const StopFn& stop) {
  {
    absl::MutexLock lock(&mutex_);
    const bool is_wanted = belief_ != nullptr && belief_->revision == revision;
    if (is_wanted && belief_host_.lock() == host) return belief_;
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const PastMission past,
                              missions_.Make(*host, revision, "revision", PastUse::kMap, stop));
  auto belief = std::make_shared<Belief>(*past.mission->Snapshot());
  belief->gas_what_if = nullptr;  // holds as much as the field
  absl::MutexLock lock(&mutex_);
  belief_host_ = host;
  belief_ = belief;
  return belief;
}

PastMaps::EncodedPtr PastMaps::Find(const std::shared_ptr<MissionHost>& host,
                                    const PastMapWish& wish) {
  absl::MutexLock lock(&mutex_);
  for (const Kept& kept : kept_) {
    const bool is_wanted = kept.map->revision == wish.revision && kept.map->view == wish.view;
    if (is_wanted && kept.host.lock() == host) return kept.map;
  }
  return nullptr;
}

void PastMaps::Keep(Kept kept) {
  absl::MutexLock lock(&mutex_);
  kept_.push_back(std::move(kept));
  std::size_t bytes = 0;
  for (const Kept& one : kept_) bytes += BytesOfTiles(*one.map);
  while (kept_.size() > 1 && (kept_.size() > kMaxPastMaps || bytes > kMaxPastMaps_bytes)) {
    bytes -= BytesOfTiles(*kept_.front().map);
    kept_.pop_front();
  }
}

}  // namespace plumescout::server
