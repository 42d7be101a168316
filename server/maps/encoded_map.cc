// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/encoded_map.h"

#include <algorithm>
#include <utility>

#include "proto/convert/geometry.h"
#include "server/maps/wire_message.h"

namespace plumescout::server {
namespace {

using Frame = v1::WatchMapResponse;

// Bounds on what a message has beside tiles and status, and a tile beside its own bytes.
constexpr std::size_t kHead_bytes = 512;
constexpr std::size_t kTileHead_bytes = 6;

// One revision's messages, cut where they become too large.
class FrameWriter {
 public:
  FrameWriter(const EncodedMap& map, std::int64_t max_bytes)
      : map_(map), max_bytes_(static_cast<std::size_t>(max_bytes)) {}

  // The first message has the status.
  void Begin(Frame::Kind kind, std::int64_t base_revision) {
    kind_ = kind;
    base_revision_ = base_revision;
    message_.AddField(Frame::kStatusFieldNumber, map_.status);
  }
  void Add(const grpc::Slice& tile) {
    const std::size_t bytes = message_.bytes() + tile.size() + kTileHead_bytes + kHead_bytes;
    if (bytes > max_bytes_ && message_.bytes() > 0) {
      Finish(/*more_follow=*/true);
      kind_ = Frame::KIND_DELTA;
      base_revision_ = map_.revision;
    }
    message_.AddField(Frame::kTilesFieldNumber, tile);
  }
  void Finish(bool more_follow) {
    Frame head;
    head.set_kind(kind_);
    head.set_base_revision(base_revision_);
    head.set_revision(map_.revision);
    *head.mutable_tile_geometry() = ToProto(map_.squares);
    head.set_more_follow(more_follow);
    message_.Merge(head);
    frames_.messages.push_back(std::exchange(message_, {}).Build());
  }
  void Reset(std::int64_t held) {
    Frame reset;
    reset.set_kind(Frame::KIND_RESET);
    reset.set_base_revision(held);
    reset.set_revision(map_.revision);
    reset.set_more_follow(true);
    WireMessage message;
    message.Merge(reset);
    frames_.messages.push_back(message.Build());
  }
  MapFrames Take() {
    frames_.revision = map_.revision;
    return std::move(frames_);
  }

 private:
  const EncodedMap& map_;
  const std::size_t max_bytes_;
  Frame::Kind kind_ = Frame::KIND_UNSPECIFIED;
  std::int64_t base_revision_ = 0;
  WireMessage message_;
  MapFrames frames_;
};

}  // namespace

MapFrames FramesSince(std::int64_t held, const EncodedMap& map, std::int64_t max_bytes) {
  FrameWriter writer(map, max_bytes);
  if (held < map.geometry_since) {
    if (held != kHoldsNothing) writer.Reset(held);
    writer.Begin(Frame::KIND_FULL, 0);
    for (const EncodedTile& tile : map.tiles) {
      if (tile.tile.bytes.size() > 0) writer.Add(tile.tile.bytes);
    }
  } else {
    const auto differs = [&](const EncodedTile& tile) { return tile.tile.since > held; };
    const bool any = std::any_of(map.tiles.begin(), map.tiles.end(), differs);
    writer.Begin(any ? Frame::KIND_DELTA : Frame::KIND_PROGRESS, held);
    for (const EncodedTile& tile : map.tiles) {
      if (!differs(tile)) continue;
      const bool known = tile.tile.bytes.size() > 0;
      writer.Add(known ? tile.tile.bytes : UnknownTile(tile.form, tile.rect));
    }
  }
  writer.Finish(/*more_follow=*/false);
  return writer.Take();
}

MapPart CutPart(const EncodedMap& map, std::size_t first_tile, std::int64_t max_bytes) {
  MapPart part;
  part.first_tile = first_tile;
  part.end_tile = first_tile;
  part.head.set_revision(map.revision);
  *part.head.mutable_tile_geometry() = ToProto(map.squares);
  std::size_t bytes = kHead_bytes + (first_tile == 0 ? map.status.size() : 0);
  bool has_tile = false;
  for (; part.end_tile < map.tiles.size(); ++part.end_tile) {
    const std::size_t tile_bytes = map.tiles[part.end_tile].tile.bytes.size();
    if (tile_bytes == 0) continue;
    bytes += tile_bytes + kTileHead_bytes;
    if (has_tile && bytes > static_cast<std::size_t>(max_bytes)) break;
    has_tile = true;
  }
  return part;
}

grpc::ByteBuffer Build(const EncodedMap& map, const MapPart& part) {
  WireMessage message;
  message.Merge(part.head);
  if (part.first_tile == 0) message.AddField(v1::GetMapResponse::kStatusFieldNumber, map.status);
  for (std::size_t i = part.first_tile; i < part.end_tile; ++i) {
    const grpc::Slice& tile = map.tiles[i].tile.bytes;
    if (tile.size() > 0) message.AddField(v1::GetMapResponse::kTilesFieldNumber, tile);
  }
  return message.Build();
}

}  // namespace plumescout::server
