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

  // Another one whenever the field was made anew.
  static const void* EngineOf(const GasMap& map) { return map.engine_.get(); }

  // The field believes to have heard a reading of `deviation_ppm` more in cell (x, y) of the gas
  // lattice.
  static void Mislead(GasMap& map, GasCell cell, double deviation_ppm) {
    constexpr double kPrecision = 10.0;
    CellInput input = map.inputs_.Of(cell);
    input.precision += kPrecision;
    input.weighted_deviation += kPrecision * deviation_ppm;
    const CellChange change{map.lattice_.Index(cell), input};
    EXPECT_TRUE(map.engine_->Apply({&change, 1}).ok());
    map.published_ = false;
  }

  // From now on no field that is made anew can be computed.
  static void LosePrior(GasMap& map) {
    map.field_options_.prior.prior_precision_per_ppm2 = std::nan("");
  }
  static void FindPrior(GasMap& map) {
    map.field_options_.prior.prior_precision_per_ppm2 =
        PublishedGasOptions().prior_precision_per_ppm2;
  }
};

}  // namespace plumescout
