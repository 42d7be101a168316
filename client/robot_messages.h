// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "client/join.h"
#include "client/robot_details.h"
#include "plumescout/v1/robot_service.pb.h"

namespace plumescout::client {

v1::RegisterRobotRequest RegistrationOf(const Participation& participation);

// kInvalidArgument naming the field. A link of a newer server is kUnknown.
absl::StatusOr<RobotDetails> DetailsFromProto(const v1::Robot& proto);

}  // namespace plumescout::client
