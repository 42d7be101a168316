// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lab/trials/map_calibration.h"

namespace plumescout::lab {

// As studies keep finished trials. JSON has no NaN: such values are null.
double NumberFrom(const nlohmann::json& value);
nlohmann::json ToJson(const MapCalibration& map);
// Throws nlohmann::json::exception if a figure is missing.
MapCalibration CalibrationFrom(const nlohmann::json& value);

}  // namespace plumescout::lab
