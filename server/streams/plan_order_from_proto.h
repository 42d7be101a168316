// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "plumescout/v1/planning_service.pb.h"
#include "server/calls/service_context.h"
#include "server/missions/plan_job.h"
#include "server/missions/team_job.h"

namespace plumescout::server {

// What a request orders, but the robot and the deadline. A budget above the server's is cut to it.
absl::StatusOr<PlanOrder> PlanOrderFromProto(const v1::NextBestTrajectoryRequest& request,
                                             const ServiceLimits& limits);
absl::StatusOr<PlanOrder> PlanOrderFromProto(const v1::StreamNextBestTrajectoryRequest& request,
                                             const ServiceLimits& limits);

// Likewise, but the mission. Errors: a robot of another mission, too many of them.
absl::StatusOr<TeamOrder> TeamOrderFromProto(const v1::PlanTeamRequest& request,
                                             const MissionId& mission, const ServiceLimits& limits);

}  // namespace plumescout::server
