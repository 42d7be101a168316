// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/gas/field/field_engine.h"
#include "core/gas/gas_inputs.h"
#include "core/gas/gas_lattice.h"
#include "core/gas/noise_scale.h"
#include "core/types/options.h"

namespace plumescout {

// What precisions of the prior make readings most likely. With Q that of the options and Lambda the
// diagonal of the precisions of readings, H = theta Q + Lambda; theta is learned, and the scale s
// of all variances beside it (NoiseScale). So lambda_p and lambda_d become theta / s times those of
// the options, lambda_o 1 / s times.
//
// Given theta, z ~ N(0, s C) with C = Lambda^-1 + Q^-1 / theta at the readings. With s integrated
// over its prior, an inverse gamma one with a = 2 and b = 1, and up to what theta does not change,
//   ln p(z | theta) = N / 2 ln theta - ln |H| / 2 - (2 + n / 2) ln(1 + E / 2),
// where E = z^T C^-1 z is the least of sum lambda_k (z_k - m)^2 + theta m^T Q m over all fields m
// (N cells, n data). Of such a minimum only what theta stands before changes with it:
//   d E / d ln theta = theta m^T Q m =: P,
//   d ln |H| / d ln theta = tr(H^-1 theta Q) = N - tr(H^-1 Lambda) = N - gamma.
// So the slope by ln theta is gamma / 2 - (4 + n) / (2 + E) P / 2: that of the determinant needs
// nothing of the inverse but its diagonal where readings are. And P = h^T m - m^T Lambda m.
//
// A reading along the way (WayReadings) is told as one datum for each cell that it passed. Those
// are what gamma counts, so n does, too: for n readings, theta would become as large as may be.
//
// With A = Lambda^1/2 H^-1 Lambda^1/2, whose trace is gamma, and r = theta Q m = h - Lambda m the
// slope falls by
//   (gamma - tr(A^2)) / 2 + (4 + n) / 2 ((P - 2 r^T H^-1 r) / (2 + E) - (P / (2 + E))^2),
// and is expected to, s unknown, by (tr(A^2) - gamma^2 / (4 + n)) / 2. Steps go by the larger of
// them: gas is no draw of the field, and what is expected is too little by 4 to 50 times, whose
// steps go to and fro over the best theta. In place of tr(A^2) stands the sum of the squares on the
// diagonal of A, which is not above it: that costs nothing, and steps become no longer.
//
// theta itself is a priori log-normal about 1 with kPriorLogStddev, so that few readings hardly
// move it.
struct PriorScale {
  double theta = 1.0;
  double log_stddev = 0.0;  // of ln theta, a posteriori; 0: not learned yet
  // In the posterior when it was; but of a step that was cut short so few that the next comes
  // after kFirstLesson more.
  std::int64_t readings = 0;
};

// Bounds of theta. Beside them it is never above max(1, s): as NoiseScale for lambda_o, so that
// neither makes a field surer than the precisions of the options do.
inline constexpr double kLeastPriorScale = 1e-4;
inline constexpr double kMostPriorScale = 1e4;
inline constexpr double kPriorLogStddev = 1.0;
// No step of ln theta is longer, and none is taken that is shorter than this share of its standard
// deviation.
inline constexpr double kMostLogStep = 1.4;
inline constexpr double kLeastStepShare = 0.1;
// Readings before the first step, and by how much more there are before the next.
inline constexpr std::int64_t kFirstLesson = 20;
inline bool IsLessonDue(const PriorScale& last, std::int64_t readings) {
  return readings >= std::max(kFirstLesson, last.readings + last.readings / 2);
}

// Beside the fit what theta goes by. Cost: O(cells with readings).
struct PriorFit : FieldFit {
  double prior_energy = 0.0;      // P
  double freedoms = 0.0;          // gamma, that of the cells whose readings count
  double squared_freedoms = 0.0;  // sum A_ii^2
  double response = 0.0;          // r^T H^-1 r
};
FieldFit FitOf(const FieldEngine& field, const GasLattice& lattice, const GasInputs& inputs,
               const GasOptions& gas);
// Cost: that of a Solve beside.
PriorFit PriorFitOf(const FieldEngine& field, const GasLattice& lattice, const GasInputs& inputs,
                    const GasOptions& gas);

// d ln p(theta | z) / d ln theta.
double LogSlope(const PriorFit& fit, double theta);
// - d LogSlope / d ln theta, or what of that is expected if it is more.
double LogCurvature(const PriorFit& fit);
// One step of Newton's method from the theta that `fit` is of, of so many readings.
PriorScale Improved(const PriorScale& now, const PriorFit& fit, std::int64_t readings);

// s beside theta, never so small that theta / s is above 1.
NoiseEstimate NoiseOf(const FieldFit& fit, const PriorScale& prior);

// Precisions of the options on their lattice (core/gas/coarse_prior.h), times theta.
GasOptions WithPriorScale(GasOptions gas, const PriorScale& prior);
FieldPrior PriorOf(const GasOptions& gas, const PriorScale& prior);

}  // namespace plumescout
