// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/calibration_json.h"

#include <limits>
#include <nlohmann/json.hpp>

namespace plumescout::lab {

using nlohmann::json;

double NumberFrom(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

json ToJson(const MapCalibration& map) {
  json value = {{"estimated_cells", map.estimated_cells}};
  for (const CalibrationFigure& figure : kCalibrationFigures) {
    value[figure.name] = map.*figure.value;
  }
  return value;
}

MapCalibration CalibrationFrom(const json& value) {
  MapCalibration map;
  value.at("estimated_cells").get_to(map.estimated_cells);
  for (const CalibrationFigure& figure : kCalibrationFigures) {
    map.*figure.value = NumberFrom(value.at(figure.name));
  }
  return map;
}

}  // namespace plumescout::lab
