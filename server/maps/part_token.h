// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "core/types/ids.h"
#include "proto/convert/map.h"

namespace plumescout::server {

// Where the next part of a map begins.
struct PartPlace {
  std::int64_t revision = 0;
  std::size_t tile = 0;

  friend bool operator==(const PartPlace&, const PartPlace&) = default;
};

// Armoured, so that nobody builds one by hand; it fits the mission and the view alone.
std::string PartToken(const PartPlace& place, const MissionId& mission, const MapView& view);
// INVALID_ARGUMENT for other texts, and for tokens of other missions and views.
absl::StatusOr<PartPlace> ReadPartToken(const std::string& token, const MissionId& mission,
                                        const MapView& view);

}  // namespace plumescout::server
