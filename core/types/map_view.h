// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/rectangle.h"

namespace plumescout {

// What a reader of maps asks for.
struct MapView {
  bool occupancy = true;
  bool gas_mean = true;
  bool gas_variance = true;
  bool full_precision = false;                     // gas layers as float32
  int level_of_detail = 0;                         // squares of 2^n by 2^n cells make one
  std::optional<Rectangle> region = std::nullopt;  // none: all of the map
  std::vector<std::string> species = {};           // of gas layers; none: the first

  friend bool operator==(const MapView&, const MapView&) = default;
};

inline constexpr int kMaxLevelOfDetail = 6;

}  // namespace plumescout
