// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/gas_sensor.h"
#include "plumescout/v1/robot_service.pb.h"

namespace plumescout {

// What a robot says of its sensors, as it is: the mission checks it.
std::vector<GasSensor> SensorsFromProto(const v1::RegisterRobotRequest& request);
void ToProto(const std::vector<GasSensor>& sensors, v1::RegisterRobotRequest& request);

}  // namespace plumescout
