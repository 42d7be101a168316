// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/gas_sensor.h"

namespace plumescout::client {

// Gas sensors, each written as ID,AHEAD,LEFT,STDDEV,OFFSET_STDDEV,SPECIES,RESPONSE_TIME in
// metres, ppm and seconds; what is left out at the end is 0, or the mission's first gas.
// kInvalidArgument quoting the text that is none. Whether ids, numbers and gases make sense is for
// the mission to judge.
absl::StatusOr<std::vector<GasSensor>> ReadSensors(const std::vector<std::string>& texts);

}  // namespace plumescout::client
