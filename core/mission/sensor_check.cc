// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/sensor_check.h"

#include <set>
#include <string>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/ids.h"
#include "core/types/species.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr double kMaxDistance_m = 10.0;
constexpr double kMaxStddev_ppm = 1e6;  // pure gas
constexpr double kMaxResponseTime_s = 3600.0;

absl::Status CheckSensor(const GasSensor& sensor, const std::string& field) {
  PLUMESCOUT_RETURN_IF_ERROR(ValidateId(absl::StrCat(field, ".id"), sensor.id));
  const Point2 place = sensor.robot_from_sensor;
  // An offset belongs to a reading, and those of such a sensor are told in parts.
  if (sensor.offset_stddev_ppm > 0.0 && sensor.response_time_s > 0.0) {
    return absl::InvalidArgumentError(
        absl::StrCat(field, ".offset_stddev_ppm = ", sensor.offset_stddev_ppm,
                     " must be 0 of a sensor with response_time_s = ", sensor.response_time_s));
  }
  return Checker()
      .InRange(absl::StrCat(field, ".robot_from_sensor.x_m"), place.x_m, -kMaxDistance_m,
               kMaxDistance_m)
      .InRange(absl::StrCat(field, ".robot_from_sensor.y_m"), place.y_m, -kMaxDistance_m,
               kMaxDistance_m)
      .InRange(absl::StrCat(field, ".stddev_ppm"), sensor.stddev_ppm, 0.0, kMaxStddev_ppm)
      .InRange(absl::StrCat(field, ".offset_stddev_ppm"), sensor.offset_stddev_ppm, 0.0,
               kMaxStddev_ppm)
      .InRange(absl::StrCat(field, ".response_time_s"), sensor.response_time_s, 0.0,
               kMaxResponseTime_s)
      .status();
}

}  // namespace

absl::Status CheckSensors(const std::vector<GasSensor>& sensors) {
  if (sensors.size() > kMostSensors) {
    return absl::InvalidArgumentError(absl::StrCat(
        "gas_sensors has ", sensors.size(), " sensors, must have ", kMostSensors, " at most"));
  }
  std::set<std::string> ids;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const std::string field = absl::StrCat("gas_sensors[", i, "]");
    PLUMESCOUT_RETURN_IF_ERROR(CheckSensor(sensors[i], field));
    if (!ids.insert(sensors[i].id).second) {
      return absl::InvalidArgumentError(
          absl::StrCat(field, ".id = \"", sensors[i].id, "\" is that of another sensor"));
    }
  }
  return absl::OkStatus();
}

absl::Status CheckOffsets(const std::vector<GasSensor>& sensors, const GasOptions& gas) {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].offset_stddev_ppm == 0.0) continue;
    if (gas.scale != GasScale::kLinear) {
      return absl::InvalidArgumentError(
          absl::StrCat("gas_sensors[", i, "].offset_stddev_ppm = ", sensors[i].offset_stddev_ppm,
                       " must be 0 in a mission with gas.scale = square_root"));
    }
    if (gas.ageing_half_life_s == 0.0) continue;
    return absl::InvalidArgumentError(
        absl::StrCat("gas_sensors[", i, "].offset_stddev_ppm = ", sensors[i].offset_stddev_ppm,
                     " must be 0 in a mission with ageing_half_life_s = ", gas.ageing_half_life_s));
  }
  return absl::OkStatus();
}

absl::Status CheckSpecies(const std::vector<GasSensor>& sensors, const MissionOptions& options) {
  constexpr std::size_t kMostQuoted = 80;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const std::string& species = sensors[i].species;
    if (FindSpecies(options, species)) continue;
    const std::string names = SpeciesNames(options);
    return absl::InvalidArgumentError(absl::StrCat(
        "gas_sensors[", i, "].species = \"", absl::CHexEscape(species.substr(0, kMostQuoted)),
        "\" must be empty", names.empty() ? ": the mission names no gas" : " or one of ", names));
  }
  return absl::OkStatus();
}

}  // namespace plumescout
