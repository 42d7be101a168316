// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/sensor_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace plumescout::client {
namespace {

constexpr std::size_t kMostBeams = 100'000;
constexpr double kPpbPerPpm = 1000.0;
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kNothing = std::numeric_limits<float>::infinity();

absl::Status Wrong(absl::string_view field, double value) {
  return absl::InvalidArgumentError(absl::StrCat(field, " is ", value));
}

float ToRange(float range_m, const ros::LaserScan& message) {
  if (std::isnan(range_m) || range_m <= 0.0F || range_m < message.range_min) return kUnknown;
  return range_m > message.range_max ? kNothing : range_m;
}

std::string NameOfUnit(int unit) {
  switch (unit) {
    case 0:
      return "UNKNOWN";
    case 1:
      return "VOLT";
    case 2:
      return "AMP";
    case 5:
      return "OHM";
    case 6:
      return "PPMXM";
    case 100:
      return "CENTIGRADE";
    case 101:
      return "RELATIVEHUMIDITY";
    default:
      return absl::StrCat(unit);
  }
}

}  // namespace

absl::StatusOr<Scan> ToScan(const ros::LaserScan& message, bool upside_down) {
  const double step_rad = message.angle_increment;
  if (!std::isfinite(message.angle_min)) return Wrong("angle_min", message.angle_min);
  if (!std::isfinite(step_rad) || step_rad == 0.0) return Wrong("angle_increment", step_rad);
  if (!(message.range_max > 0.0F) || !std::isfinite(message.range_max)) {
    return Wrong("range_max", message.range_max);
  }
  if (message.ranges.empty() || message.ranges.size() > kMostBeams) {
    return Wrong("the number of ranges", static_cast<double>(message.ranges.size()));
  }
  Scan scan{.start_angle_rad = message.angle_min,
            .angle_step_rad = step_rad,
            .max_range_m = message.range_max};
  scan.ranges_m.reserve(message.ranges.size());
  for (const float range_m : message.ranges) scan.ranges_m.push_back(ToRange(range_m, message));
  // Angles grow counter-clockwise as seen from above, whichever way the sensor counts.
  const bool backwards = (step_rad < 0.0) != upside_down;
  if (upside_down) {
    scan.start_angle_rad = -scan.start_angle_rad;
    scan.angle_step_rad = -scan.angle_step_rad;
  }
  if (backwards) {
    scan.start_angle_rad += scan.angle_step_rad * static_cast<double>(scan.ranges_m.size() - 1);
    scan.angle_step_rad = -scan.angle_step_rad;
    std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
  }
  return scan;
}

absl::StatusOr<GasCalibration> ReadCalibration(const std::string& text) {
  const std::vector<std::string> parts = absl::StrSplit(text, ',');
  GasCalibration calibration;
  const bool numbers = parts.size() == 2 && absl::SimpleAtod(parts[0], &calibration.scale_ppm) &&
                       absl::SimpleAtod(parts[1], &calibration.exponent);
  if (!numbers || !(calibration.scale_ppm > 0.0) || !std::isfinite(calibration.scale_ppm) ||
      !std::isfinite(calibration.exponent)) {
    return absl::InvalidArgumentError(
        absl::StrCat("calibration \"", text, "\" is not SCALE,EXPONENT with a positive scale"));
  }
  return calibration;
}

absl::StatusOr<GasReading> ToGasReading(const ros::GasSensor& message,
                                        const std::optional<GasCalibration>& calibration) {
  double ppm = message.raw;
  if (message.raw_units == ros::GasSensor::kPpb) {
    ppm /= kPpbPerPpm;
  } else if (message.raw_units == ros::GasSensor::kVolt ||
             message.raw_units == ros::GasSensor::kOhm) {
    if (!calibration) {
      return absl::InvalidArgumentError(
          absl::StrCat("raw_units is ", NameOfUnit(message.raw_units),
                       ", which is no concentration without a calibration (--gas-calibration)"));
    }
    ppm = calibration->scale_ppm * std::pow(message.raw, calibration->exponent);
  } else if (message.raw_units != ros::GasSensor::kPpm) {
    return absl::InvalidArgumentError(absl::StrCat("raw_units is ", NameOfUnit(message.raw_units),
                                                   ", which is no concentration"));
  }
  if (!std::isfinite(ppm)) return Wrong("raw", message.raw);
  // Detectors that see nothing read a little below zero.
  return GasReading{.concentration_ppm = std::max(ppm, 0.0)};
}

absl::Status CheckWind(const ros::Anemometer& message) {
  if (!(message.wind_speed >= 0.0F) || !std::isfinite(message.wind_speed)) {
    return Wrong("wind_speed", message.wind_speed);
  }
  if (!std::isfinite(message.wind_direction))
    return Wrong("wind_direction", message.wind_direction);
  return absl::OkStatus();
}

}  // namespace plumescout::client
