// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"
#include "core/types/rectangle.h"
#include "core/types/trajectory.h"
#include "lab/report/bar_chart.h"
#include "lab/report/map_panel.h"

namespace plumescout::lab {

struct TimedPlace {
  double time_s = 0.0;
  Point2 place;
};

// A plan while it was live.
struct TimedWay {
  double begin_s = 0.0;  // when the robot left, by plan
  double end_s = 0.0;    // when it was done with it
  Trajectory trajectory;
};

// One robot of a team in pictures.
struct TeamMember {
  std::string name;
  std::vector<TimedPlace> driven;  // in order
  std::vector<TimedWay> ways;      // in order
  // Of all that the team did, [0, 1].
  double area_share = 0.0;  // what it saw first, of what they saw
  double readings_share = 0.0;
  double way_share = 0.0;
};

struct TeamPicture {
  std::vector<TeamMember> members;
  // Half the width of a tube: a robot's radius and half the clearance that two keep, so that tubes
  // overlap where they would be too near.
  double reach_m = 0.25;
};

// The moment at which most robots are on their ways; of those the one with most of them ahead. 0 if
// there are no ways.
double BusiestMoment_s(const TeamPicture& team);

// Live plans as tubes, as wide as each robot and its half of the clearance on either side, in the
// robots' colours: full where they are at that time, paler the later they come there. Where tubes
// cross, the sooner is on top.
MapPanel TubesPanel(const TeamPicture& team, const Grid<CellState>& map, const Rectangle& region,
                    double time_s);

// Where robots drove, as wide, pale at first and full at the end; the later is on top.
MapPanel DrivenPanel(const TeamPicture& team, const Grid<CellState>& map, const Rectangle& region);

// Who did how much of what the team did, per cent.
BarChart ShareChart(const TeamPicture& team);

}  // namespace plumescout::lab
