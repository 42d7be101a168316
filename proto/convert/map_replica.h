// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "core/types/map_changes.h"
#include "core/types/map_snapshot.h"
#include "plumescout/v1/map_service.pb.h"

namespace plumescout {

// A watcher's copy of a map, kept as WatchMapResponse says. Layers that are not watched stay
// unknown, NaN.
class MapReplica {
 public:
  // kInvalidArgument naming the field of a frame that does not fit the copy or cannot be read; the
  // copy is then of no use any more.
  absl::Status Apply(const v1::WatchMapResponse& frame);

  const MapSnapshot& map() const { return map_; }
  // Whether the map is that of one revision: more of it would follow else, or none has come.
  bool whole() const { return whole_; }

  // How the map has changed since the last call.
  MapChanges TakeChanges();

 private:
  absl::Status Restart(const v1::WatchMapResponse& frame);

  MapSnapshot map_;
  bool held_ = false;  // a map, which deltas go on top of
  bool whole_ = false;
  MapChanges changes_;
};

}  // namespace plumescout
