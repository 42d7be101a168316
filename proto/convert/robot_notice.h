// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "core/types/ids.h"
#include "core/types/robot_notice.h"
#include "plumescout/v1/robot_service.pb.h"

namespace plumescout {

// The mission is that of the robot, and of what the notice names.
v1::WatchRobotResponse ToProto(const RobotNotice& notice, const MissionId& mission);

// kInvalidArgument naming the field. One of a newer kind is refused as well.
absl::StatusOr<RobotNotice> FromProto(const v1::WatchRobotResponse& proto);

}  // namespace plumescout
