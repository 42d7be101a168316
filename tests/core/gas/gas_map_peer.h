// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "core/gas/gas_map.h"

namespace plumescout {

// Breaks what a gas map takes for granted. Builds with assertions stop at what follows from it.
struct GasMapPeer {
#ifdef NDEBUG
  static constexpr bool kStopsAtDefects = false;
#else
  static constexpr bool kStopsAtDefects = true;
#endif

  static constexpr char kDefect[] = "not finite";  // what such builds say then

  // From now on no field that is made anew can be computed.
  static void LosePrior(GasMap& map) {
    map.field_options_.prior.prior_precision_per_ppm2 = std::nan("");
  }
  static void FindPrior(GasMap& map) {
    map.field_options_.prior.prior_precision_per_ppm2 = GasOptions().prior_precision_per_ppm2;
  }
};

}  // namespace plumescout
