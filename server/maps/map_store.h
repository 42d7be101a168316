// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "proto/convert/map.h"
#include "server/maps/encoded_map.h"
#include "server/maps/layer_tiles.h"

namespace plumescout::server {

// What a store has done for all who read; tests count it.
struct MapStoreCounts {
  std::int64_t revisions = 0;  // each with one search for frontiers
  std::int64_t tiles = 0;      // encoded
  std::int64_t frames = 0;     // made for watchers, however many got them
};

// The map of one mission, encoded once for all who read it: a search for frontiers a revision, and
// an encoding of each tile a change. It holds the newest revision that somebody asked for, and of
// earlier ones those that are being read in parts. Thread-safe. Calls wait for each other's
// encoding: they are for pools, not for reactors.
class MapStore {
 public:
  // No message of the map has more than `max_part_bytes`, but for single tiles.
  MapStore(MissionId mission, std::int64_t max_part_bytes)
      : mission_(std::move(mission)), max_part_bytes_(max_part_bytes) {}

  // The map of this belief, or of a later one that somebody has come with.
  std::shared_ptr<const EncodedMap> Encode(const Belief& belief, const MapView& view)
      ABSL_LOCKS_EXCLUDED(mutex_);
  // What brings a watcher from the revision `held` to that map.
  std::shared_ptr<const MapFrames> FramesSince(std::int64_t held, const Belief& belief,
                                               const MapView& view) ABSL_LOCKS_EXCLUDED(mutex_);

  // v1::GetMapResponse of that map: its first part. `max_bytes`: 0, or what the caller wants less.
  grpc::ByteBuffer FirstPart(const Belief& belief, const MapView& view, std::int64_t max_bytes)
      ABSL_LOCKS_EXCLUDED(mutex_);
  // The part that a token names. ABORTED (MAP_PARTS_GONE) if the token's revision is not held.
  absl::StatusOr<grpc::ByteBuffer> NextPart(const std::string& token, const MapView& view,
                                            std::int64_t max_bytes) ABSL_LOCKS_EXCLUDED(mutex_);

  MapStoreCounts counts() const ABSL_LOCKS_EXCLUDED(mutex_);
  std::int64_t max_part_bytes() const { return max_part_bytes_; }

 private:
  using EncodedPtr = std::shared_ptr<const EncodedMap>;
  struct SharedFrames {
    std::int64_t held = 0;
    EncodedPtr map;
    std::shared_ptr<const MapFrames> frames;
  };

  void Advance(const Belief& belief) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  EncodedPtr EncodeNow(const MapView& view) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void AddLayer(const LayerForm& form, EncodedMap& map) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  grpc::ByteBuffer PartFrom(std::size_t tile, const EncodedPtr& map, std::int64_t max_bytes)
      ABSL_LOCKS_EXCLUDED(mutex_);
  // Keeps a map for those who read it in parts, and lets the oldest of those go.
  void Keep(const EncodedPtr& map) ABSL_LOCKS_EXCLUDED(mutex_);

  const MissionId mission_;
  const std::int64_t max_part_bytes_;

  mutable absl::Mutex mutex_;
  bool has_map_ ABSL_GUARDED_BY(mutex_) = false;
  MapRasters rasters_ ABSL_GUARDED_BY(mutex_);
  std::int64_t audits_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t geometry_since_ ABSL_GUARDED_BY(mutex_) = 0;
  grpc::Slice status_ ABSL_GUARDED_BY(mutex_);
  std::map<LayerForm, LayerTiles> layers_ ABSL_GUARDED_BY(mutex_);
  // Of the present revision, each a few.
  std::deque<EncodedPtr> encoded_ ABSL_GUARDED_BY(mutex_);
  std::deque<SharedFrames> frames_ ABSL_GUARDED_BY(mutex_);
  // Of any revision: those of which a reader may want another part.
  std::deque<EncodedPtr> kept_ ABSL_GUARDED_BY(mutex_);
  MapStoreCounts counts_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
