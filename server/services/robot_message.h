// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "plumescout/v1/robot_service.pb.h"
#include "proto/convert/names.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

// What GetRobot and ListRobots tell of a robot of the belief, which is of the host's mission.
v1::Robot DescribeRobot(const RobotRecord& record, const Belief& belief, MissionHost& host);

// Whom an order is for; robot empty: all of the mission. kInvalidArgument naming the field.
absl::StatusOr<RobotName> ReadHomeOrder(const v1::OrderHomeRequest& request);

}  // namespace plumescout::server
