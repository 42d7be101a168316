// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "core/types/rng.h"

namespace plumescout::lab {

// A sensor with a first-order lag. The defaults are a photo-ionisation detector's. How often it is
// read is up to the robot (2 Hz in [XIT] Table I).
struct GasSensorOptions {
  double time_constant_s = 0.5;       // of the first-order lag, [0, 3600]
  double noise_sigma_ppm = 0.1;       // additive, [0, 1e6]
  double noise_share = 0.01;          // relative to the concentration, [0, 1]
  double detection_limit_ppm = 0.05;  // what would read less reads 0, [0, 1e6]
  double saturation_ppm = 10'000.0;   // what would read more reads this, (0, 1e6]
  double resolution_ppm = 0.0;        // readings are whole multiples of it, [0, 1e6]; 0: any number

  friend bool operator==(const GasSensorOptions&, const GasSensorOptions&) = default;
};

// Acetone and other vapours: fast enough to be read on the way, [XIT] section VI-A.
GasSensorOptions PhotoIonisationDetector();

// Infrared cell for carbon dioxide, in the manner of the COZIR-A of [XIT] section VII: so slow that
// the robot has to stand for a reading, and it says multiples of 10 ppm. The paper states no
// figures; 4 s is what makes 5 s of standing "reliable" to 70 %, and more with the lag undone.
GasSensorOptions CarbonDioxideCell();

// kInvalidArgument naming field, value and range.
absl::Status Validate(const GasSensorOptions& options);

// The cell of the sensor follows the air around it; readings of it are noisy and never negative.
class GasSensor {
 public:
  // Starts at rest in air of `ambient_ppm`. REQUIRES: valid options.
  GasSensor(const GasSensorOptions& options, std::uint64_t seed, double ambient_ppm = 0.0);

  // `duration_s` in air of constant concentration: exact solution of dc/dt = (true - c) / tau.
  void Step(double true_ppm, double duration_s);
  double Read_ppm();

 private:
  GasSensorOptions options_;
  Rng rng_;
  double cell_ppm_;
};

}  // namespace plumescout::lab
