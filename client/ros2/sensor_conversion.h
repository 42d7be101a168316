// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/types/gas_reading.h"
#include "core/types/scan.h"
#include "formats/ros/messages.h"

namespace plumescout::client {

// The scan in the sensor's own frame. Ranges that say nothing (NaN, below range_min, not positive)
// become NaN, those beyond range_max infinity. `upside_down`: the sensor's z axis points down.
// kInvalidArgument naming the field that makes no sense.
absl::StatusOr<Scan> ToScan(const ros::LaserScan& message, bool upside_down);

// How what a sensor measures in volts or ohms becomes a concentration:
// ppm = scale * raw ^ exponent. None: it does not.
struct GasCalibration {
  double scale_ppm = 0.0;
  double exponent = 1.0;
};
// From "SCALE,EXPONENT". kInvalidArgument quoting what is none.
absl::StatusOr<GasCalibration> ReadCalibration(const std::string& text);

// kInvalidArgument naming the unit that is not a concentration, or a value that is none.
absl::StatusOr<GasReading> ToGasReading(const ros::GasSensor& message,
                                        const std::optional<GasCalibration>& calibration);

// kInvalidArgument naming the value that is no wind.
absl::Status CheckWind(const ros::Anemometer& message);

}  // namespace plumescout::client
