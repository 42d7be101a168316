// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "absl/status/status.h"
#include "core/types/gas_sensor.h"
#include "core/types/options.h"

namespace plumescout {

// Of one robot.
inline constexpr std::size_t kMostSensors = 16;

// kInvalidArgument naming field and value: too many, an id that is none or comes twice, a sensor
// farther from its robot than robots are wide, a deviation that is negative or absurd.
absl::Status CheckSensors(const std::vector<GasSensor>& sensors);
// Likewise, for an unknown offset in a mission whose readings age: it is not told apart from those.
absl::Status CheckOffsets(const std::vector<GasSensor>& sensors, const GasOptions& gas);
// Likewise, for a sensor of a gas that the mission does not map.
absl::Status CheckSpecies(const std::vector<GasSensor>& sensors, const MissionOptions& options);

}  // namespace plumescout
