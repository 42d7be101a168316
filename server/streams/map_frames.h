// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/map_snapshot.h"
#include "plumescout/v1/map_service.pb.h"
#include "proto/convert/map.h"

namespace plumescout::server {

inline constexpr int kDeltaTileCells = 64;

// The frames that bring a reader who holds `before` (null: nothing) to `now`: FULL, or RESET and
// FULL if the raster moved or grew, or DELTA with the tiles that differ, or PROGRESS if only the
// status does, or none.
std::vector<v1::WatchMapResponse> FramesBetween(const MapSnapshot* before, const MapSnapshot& now,
                                                const MissionId& mission, const MapView& view);

}  // namespace plumescout::server
