// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "core/types/options.h"
#include "lab/report/sheet.h"
#include "lab/report/team_panels.h"
#include "lab/sim/episode.h"
#include "lab/sim/scene_world.h"
#include "lab/sim/simulated_robot.h"
#include "lab/trials/trial.h"

namespace plumescout::lab {

// What robots of a team are to pictures.
struct TeamLook {
  double lidar_range_m = LidarOptions().max_range_m;
  double radius_m = SimulatedRobotOptions().seen_radius_m;
  double clearance_m = PlanningOptions().robot_clearance_m;
};

// What a team did, ready to be drawn: the plans that robots set out on, each until its leg ended or
// the next one came; where they drove; and how much of it all each one did.
TeamPicture MakeTeamPicture(const TeamResult& team, const SceneWorld& world, const TeamLook& look);

// Drives the trial, and adds its picture: the tubes of its busiest moment, where robots drove, and
// their shares. Errors: as RunTrial.
absl::Status AddTeamPicture(Trial trial, ReportFigures& figures);

}  // namespace plumescout::lab
