// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/report/image.h"

namespace plumescout::lab {

// Both run from dark to light with evenly growing lightness, so that they can be read in grey and
// by the colour-blind.
enum class ColorMap { kGas, kUncertainty };  // violet - teal - yellow; plum - rose - cream

// Colour of `share` in [0, 1] of the way along the map; beyond its ends the end. REQUIRES: not NaN.
Rgb ColorAt(ColorMap map, double share);

// How values become colours.
struct ColorScale {
  ColorMap map = ColorMap::kGas;
  double low = 0.0;          // gets the first colour, as does everything below
  double high = 1.0;         // > low
  bool logarithmic = false;  // then low > 0

  // Where the value lies between low and high, in [0, 1].
  double Share(double value) const;
  Rgb operator()(double value) const { return ColorAt(map, Share(value)); }
};

}  // namespace plumescout::lab
