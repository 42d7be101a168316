// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumescout/v1/robot_service.pb.h"
#include "tests/server/bad_robot_input.h"

namespace plumescout::server {

inline BadInputs BadOrderHome() {
  using Request = v1::OrderHomeRequest;
  return BadInputs()
      .Rows(BadRobotName("robot"))
      .Rows(UnknownMission("robot"))
      .Rows(BadMissionName("mission"))
      .Row({"target", "none", [](Message& m) { static_cast<Request&>(m).clear_target(); },
            absl::StatusCode::kInvalidArgument, "target"});
}

}  // namespace plumescout::server
