// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/color_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace plumescout::lab {
namespace {

// Colour in Oklab (Ottosson 2020): equal steps look equally large.
struct Lab {
  double lightness;    // 0 black, 1 white
  double green_red;    // a
  double blue_yellow;  // b
};

// Control points at equal distances and equal steps of lightness; hue and chroma are our choice
// within sRGB.
constexpr std::array<Lab, 6> kGasPoints = {{{0.27, 0.050, -0.110},
                                            {0.40, 0.005, -0.125},
                                            {0.53, -0.050, -0.065},
                                            {0.66, -0.095, 0.020},
                                            {0.79, -0.105, 0.120},
                                            {0.92, -0.020, 0.160}}};
constexpr std::array<Lab, 6> kUncertaintyPoints = {{{0.24, 0.060, -0.050},
                                                    {0.38, 0.115, -0.040},
                                                    {0.52, 0.145, 0.015},
                                                    {0.66, 0.120, 0.075},
                                                    {0.80, 0.045, 0.100},
                                                    {0.94, 0.000, 0.055}}};

std::uint8_t EncodeSrgb(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

// The published matrices of Oklab, from Lab to linear sRGB.
Rgb ToSrgb(const Lab& lab) {
  const auto [L, a, b] = lab;
  const double l = std::pow(L + 0.3963377774 * a + 0.2158037573 * b, 3.0);
  const double m = std::pow(L - 0.1055613458 * a - 0.0638541728 * b, 3.0);
  const double s = std::pow(L - 0.0894841775 * a - 1.2914855480 * b, 3.0);
  return {EncodeSrgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          EncodeSrgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          EncodeSrgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace

Rgb ColorAt(ColorMap map, double share) {
  const auto& points = map == ColorMap::kGas ? kGasPoints : kUncertaintyPoints;
  const double along = std::clamp(share, 0.0, 1.0) * static_cast<double>(points.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(along), points.size() - 2);
  const double t = along - static_cast<double>(i);
  const auto mix = [t](double from, double to) { return from + t * (to - from); };
  return ToSrgb({mix(points[i].lightness, points[i + 1].lightness),
                 mix(points[i].green_red, points[i + 1].green_red),
                 mix(points[i].blue_yellow, points[i + 1].blue_yellow)});
}

double ColorScale::Share(double value) const {
  const double bounded = std::clamp(value, low, high);
  if (logarithmic) return std::log(bounded / low) / std::log(high / low);
  return (bounded - low) / (high - low);
}

}  // namespace plumescout::lab
