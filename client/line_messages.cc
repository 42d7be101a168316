// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/line_messages.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

using Json = nlohmann::json;

constexpr int kSensorEnd = 1000;  // no robot has so many

absl::StatusOr<double> Number(const Json& object, const char* field) {
  const auto found = object.find(field);
  if (found == object.end() || !found->is_number()) {
    return absl::InvalidArgumentError(absl::StrCat(field, " must be a number"));
  }
  const double value = found->get<double>();
  if (!std::isfinite(value)) {
    return absl::InvalidArgumentError(absl::StrCat(field, " must be finite"));
  }
  return value;
}

absl::StatusOr<std::int64_t> Time_ns(const Json& object) {
  const auto found = object.find("time_ns");
  if (found == object.end() || !found->is_number_integer()) {
    return absl::InvalidArgumentError("time_ns must be a whole number");
  }
  return found->get<std::int64_t>();
}

absl::StatusOr<Pose2> ReadPose(const Json& object) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const double x_m, Number(object, "x_m"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const double y_m, Number(object, "y_m"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const double yaw_rad, Number(object, "yaw_rad"));
  return Pose2{.x_m = x_m, .y_m = y_m, .yaw_rad = WrapAngle_rad(yaw_rad)};
}

// null: the beam says nothing; max_range_m and more: nothing was seen.
absl::StatusOr<std::vector<float>> Ranges_m(const Json& object, double max_range_m) {
  const auto found = object.find("ranges_m");
  if (found == object.end() || !found->is_array()) {
    return absl::InvalidArgumentError("ranges_m must be an array");
  }
  std::vector<float> ranges_m;
  ranges_m.reserve(found->size());
  for (const Json& range : *found) {
    if (range.is_null()) {
      ranges_m.push_back(std::numeric_limits<float>::quiet_NaN());
    } else if (!range.is_number()) {
      return absl::InvalidArgumentError("ranges_m must hold numbers and nulls");
    } else {
      const double range_m = range.get<double>();
      ranges_m.push_back(range_m >= max_range_m ? std::numeric_limits<float>::infinity()
                                                : static_cast<float>(range_m));
    }
  }
  return ranges_m;
}

absl::StatusOr<Scan> ReadScan(const Json& object) {
  Scan scan;
  PLUMESCOUT_ASSIGN_OR_RETURN(scan.start_angle_rad, Number(object, "start_angle_rad"));
  PLUMESCOUT_ASSIGN_OR_RETURN(scan.angle_step_rad, Number(object, "angle_step_rad"));
  PLUMESCOUT_ASSIGN_OR_RETURN(scan.max_range_m, Number(object, "max_range_m"));
  PLUMESCOUT_ASSIGN_OR_RETURN(scan.ranges_m, Ranges_m(object, scan.max_range_m));
  return scan;
}

absl::StatusOr<GasReading> ReadGas(const Json& object) {
  GasReading reading;
  PLUMESCOUT_ASSIGN_OR_RETURN(reading.concentration_ppm, Number(object, "concentration_ppm"));
  if (object.contains("stddev_ppm")) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const double stddev_ppm, Number(object, "stddev_ppm"));
    reading.variance_ppm2 = stddev_ppm * stddev_ppm;
  }
  if (object.contains("sensor")) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const double sensor, Number(object, "sensor"));
    PLUMESCOUT_RETURN_IF_ERROR(
        Checker()
            .InRangeBelow("sensor", sensor, 0.0, kSensorEnd)
            .Require(sensor == std::floor(sensor), "sensor", sensor, "must be a whole number")
            .status());
    reading.sensor = static_cast<int>(sensor);
  }
  return reading;
}

absl::StatusOr<PoseCorrection> ReadCorrection(const Json& object) {
  const auto found = object.find("anchors");
  if (found == object.end() || !found->is_array() || found->empty()) {
    return absl::InvalidArgumentError("anchors must be an array of at least one");
  }
  PoseCorrection correction;
  for (const Json& anchor : *found) {
    if (!anchor.is_object()) return absl::InvalidArgumentError("anchors must hold objects");
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t time_ns, Time_ns(anchor));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Pose2 pose, ReadPose(anchor));
    correction.anchors.push_back({time_ns, pose});
  }
  return correction;
}

absl::StatusOr<RobotStatus> ReadStatus(const Json& object) {
  RobotStatus status;
  PLUMESCOUT_ASSIGN_OR_RETURN(status.battery_share, Number(object, "battery_share"));
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker().InRange("battery_share", status.battery_share, 0.0, 1.0).status());
  return status;
}

absl::Status ReadReading(const Json& object, absl::string_view type, RobotLine& line) {
  if (object.contains("pose")) {
    PLUMESCOUT_ASSIGN_OR_RETURN(line.pose, ReadPose(object["pose"]));
  }
  if (type == "scan") {
    PLUMESCOUT_ASSIGN_OR_RETURN(line.reading, ReadScan(object));
  } else if (type == "gas") {
    PLUMESCOUT_ASSIGN_OR_RETURN(line.reading, ReadGas(object));
  } else if (type == "correction") {
    PLUMESCOUT_ASSIGN_OR_RETURN(line.reading, ReadCorrection(object));
  } else if (type == "status") {
    PLUMESCOUT_ASSIGN_OR_RETURN(line.reading, ReadStatus(object));
  } else {
    return absl::InvalidArgumentError(absl::StrCat("type \"", type, "\" is not known"));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<RobotLine> ParseRobotLine(absl::string_view text) {
  const Json object = Json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false);
  if (!object.is_object()) return absl::InvalidArgumentError("the line is not a JSON object");
  const auto type = object.find("type");
  if (type == object.end() || !type->is_string()) {
    return absl::InvalidArgumentError("type must be a string");
  }
  RobotLine line;
  PLUMESCOUT_ASSIGN_OR_RETURN(line.time_ns, Time_ns(object));
  const auto name = type->get<std::string>();
  if (name == "pose") {
    PLUMESCOUT_ASSIGN_OR_RETURN(line.pose, ReadPose(object));
    return line;
  }
  PLUMESCOUT_RETURN_IF_ERROR(ReadReading(object, name, line));
  return line;
}

std::string FormatTwistLine(const Twist& twist) {
  const Json object = {{"type", "twist"},
                       {"forward_mps", twist.forward_mps},
                       {"turn_rad_per_s", twist.turn_rad_per_s}};
  return absl::StrCat(object.dump(), "\n");
}

}  // namespace plumescout::client
