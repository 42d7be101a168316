// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/gas_sensor.h"
#include "core/types/ids.h"
#include "plumescout/v1/map_service.pb.h"

namespace plumescout {

v1::SensorOffset ToProto(const SensorOffset& offset, const MissionId& mission);

// kInvalidArgument naming the field.
absl::StatusOr<SensorOffset> FromProto(const v1::SensorOffset& proto, absl::string_view field);

}  // namespace plumescout
