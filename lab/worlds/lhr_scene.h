// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/types/pose2.h"
#include "lab/formats/scene.h"
#include "lab/worlds/decaying_plume.h"

namespace plumescout::lab {

// The world of [LHR] section IV: 51 x 51 nodes, 1 m apart, without obstacles. Its distances (2601 m
// of sweep, 350 m of survey) say that nodes stand at 0, 1 ... 50 m; here they are the centres of
// cells, and the paper's (0, 0) is (0.5, 0.5) in frame map.
inline constexpr int kLhrNodes = 51;         // each way
inline constexpr double kLhrOffset_m = 0.5;  // of the paper's origin, in both coordinates

// A place in the paper's coordinates, in frame map.
constexpr Point2 LhrPlace(double x_m, double y_m) {
  return {x_m + kLhrOffset_m, y_m + kLhrOffset_m};
}

struct LhrSource {
  Point2 position;  // frame map
  double rate_g_per_s = 0.0;
};

// [LHR] Table I.
std::vector<LhrSource> LhrTable1Sources();

// "The source parameters are randomised around the values in Table I", by how much the paper does
// not say. Ours: positions by 5 m (Gaussian, each way), redrawn until they lie within 0 ... 50 m;
// rates by up to 20 % (uniform). The same scenario of the same seed is the same for ever, however
// many others there are.
std::vector<LhrSource> LhrScenarioSources(std::uint64_t seed, int scenario);

// The four corners of the search domain: south-west, south-east, north-west, north-east.
std::array<Point2, 4> LhrStarts();

struct LhrAir {
  DecayingPlume plume = {};  // along -y; the paper's 3 m/s, 1 m^2/s and 8 s
  // The paper plots no unit. With this scale the largest values are 13 to 18 ppm and the root mean
  // square is some 0.8 ppm: beside variances of the gas field of 0.1 to 1 ppm^2 neither of the two
  // terms of mu + beta sigma^2 drowns the other, and readings to 10 % are no surer in clean air
  // than the field's own noise allows.
  double ppm_per_g_per_m3 = 10.0;
};

// Steady gas: one frame. The release rates of its sources are in ppm m^3/s.
Scene MakeLhrScene(const std::vector<LhrSource>& sources, const LhrAir& air = {});

}  // namespace plumescout::lab
