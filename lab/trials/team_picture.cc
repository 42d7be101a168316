// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_picture.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "lab/report/figures.h"
#include "lab/sim/team_shares.h"

namespace plumescout::lab {
namespace {

std::vector<TimedWay> WaysOf(const EpisodeResult& robot) {
  std::vector<TimedWay> ways;
  for (const IssuedPlan& issued : robot.plans) {
    if (!ways.empty()) ways.back().end_s = std::min(ways.back().end_s, issued.time_s);
    if (issued.plan.trajectory.waypoints.empty()) continue;
    ways.push_back({issued.time_s, robot.simulated_s, issued.plan.trajectory});
    for (const EndedLeg& leg : robot.legs_ended) {
      if (leg.plan == issued.plan.id) ways.back().end_s = leg.time_s;
    }
  }
  return ways;
}

}  // namespace

TeamPicture MakeTeamPicture(const TeamResult& team, const SceneWorld& world, const TeamLook& look) {
  const std::vector<RobotShares> shares = SharesOf(team, world, look.lidar_range_m);
  TeamPicture picture{{}, look.radius_m + 0.5 * look.clearance_m};
  for (std::size_t i = 0; i < team.robots.size(); ++i) {
    const EpisodeResult& robot = team.robots[i];
    TeamMember member{robot.robot,        {},           WaysOf(robot), shares[i].area,
                      shares[i].readings, shares[i].way};
    for (const DrivenPose& at : robot.path) {
      member.driven.push_back({at.time_s, at.pose.position()});
    }
    picture.members.push_back(std::move(member));
  }
  return picture;
}

absl::Status AddTeamPicture(Trial trial, ReportFigures& figures) {
  trial.on_end = [&](const TeamResult& team, const MapSnapshot& map) {
    const TeamLook look{.clearance_m = trial.mission->planning.robot_clearance_m};
    const TeamPicture picture = MakeTeamPicture(team, *trial.world, look);
    const Rectangle region = KnownRegion(map.occupancy);
    figures.panels.push_back(TubesPanel(picture, map.occupancy, region, BusiestMoment_s(picture)));
    figures.panels.push_back(DrivenPanel(picture, map.occupancy, region));
    figures.bar_charts.push_back(ShareChart(picture));
  };
  return RunTrial(trial).status();
}

}  // namespace plumescout::lab
