// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "core/types/rng.h"

namespace plumescout::lab {

// Photo-ionisation detector. How often it is read is up to the robot (2 Hz in [XIT] Table I).
struct GasSensorOptions {
  double time_constant_s = 0.5;       // of the first-order lag, [0, 3600]
  double noise_sigma_ppm = 0.1;       // additive, >= 0
  double noise_share = 0.01;          // relative to the concentration, [0, 1]
  double detection_limit_ppm = 0.05;  // what would read less reads 0, >= 0
};

// kInvalidArgument naming field, value and range.
absl::Status Validate(const GasSensorOptions& options);

// The cell of the sensor follows the air around it; readings of it are noisy and never negative.
class GasSensor {
 public:
  // Starts in clean air. REQUIRES: valid options.
  GasSensor(const GasSensorOptions& options, std::uint64_t seed);

  // `duration_s` in air of constant concentration: exact solution of dc/dt = (true - c) / tau.
  void Step(double true_ppm, double duration_s);
  double Read_ppm();

 private:
  GasSensorOptions options_;
  Rng rng_;
  double cell_ppm_ = 0.0;
};

}  // namespace plumescout::lab
