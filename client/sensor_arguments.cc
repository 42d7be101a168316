// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/sensor_arguments.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace plumescout::client {

absl::StatusOr<std::vector<GasSensor>> ReadSensors(const std::vector<std::string>& texts) {
  std::vector<GasSensor> sensors;
  for (const std::string& text : texts) {
    const std::vector<std::string> parts = absl::StrSplit(text, ',');
    GasSensor& sensor = sensors.emplace_back();
    sensor.id = parts[0];
    double* const numbers[] = {&sensor.robot_from_sensor.x_m, &sensor.robot_from_sensor.y_m,
                               &sensor.stddev_ppm, &sensor.offset_stddev_ppm};
    constexpr std::size_t kSpecies = 1 + std::size(numbers);  // its place among the parts
    constexpr std::size_t kResponseTime = kSpecies + 1;
    bool is_sensor = parts.size() <= kResponseTime + 1;
    for (std::size_t i = 1; is_sensor && i < std::min(parts.size(), kSpecies); ++i) {
      is_sensor = absl::SimpleAtod(parts[i], numbers[i - 1]);
    }
    if (is_sensor && parts.size() > kSpecies) sensor.species = parts[kSpecies];
    if (is_sensor && parts.size() > kResponseTime) {
      is_sensor = absl::SimpleAtod(parts[kResponseTime], &sensor.response_time_s);
    }
    if (!is_sensor) {
      return absl::InvalidArgumentError(
          absl::StrCat("--gas-sensor = \"", text,
                       "\" must be ID,AHEAD,LEFT,STDDEV,OFFSET_STDDEV,SPECIES,RESPONSE_TIME"));
    }
  }
  return sensors;
}

}  // namespace plumescout::client
