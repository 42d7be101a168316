// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/join.h"

namespace plumescout::client {

absl::StatusOr<RobotSession> Join(PlannerClient& client, const Participation& participation) {
  if (participation.create.has_value()) {
    absl::Status created = client.CreateMission(participation.mission, *participation.create);
    if (!created.ok() && !absl::IsAlreadyExists(created)) return created;
  }
  return client.RegisterRobot(participation.mission, participation.robot, participation.radius_m,
                              participation.take_over, participation.log_epoch,
                              {participation.frame, participation.sensors});
}

}  // namespace plumescout::client
