// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumescout {

// Point concentration. `variance_ppm2` = 0 means: use that of the sensor or, if that has none, the
// mission's model, 1 / lambda_o.
struct GasReading {
  double concentration_ppm = 0.0;
  double variance_ppm2 = 0.0;
  int sensor = 0;  // place among the robot's sensors; see RobotRegistered

  friend bool operator==(const GasReading&, const GasReading&) = default;
};

}  // namespace plumescout
