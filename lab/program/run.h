// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/types/map_snapshot.h"
#include "lab/report/objective_section.h"
#include "lab/sim/episode.h"
#include "lab/sim/scene_world.h"
#include "lab/trials/team_picture.h"

namespace plumescout::lab {

// Everything that one run leaves behind.
struct Run {
  const SceneWorld& world;
  const TeamResult& team;
  const MapSnapshot& final_map;
  std::string strategy;
  std::uint64_t seed = 0;
  double wall_s = 0.0;
  std::optional<double> server_killed_s = {};      // of simulated time
  std::optional<ObjectiveOutcome> objective = {};  // none: a complete map
  TeamLook look = {};                              // of several robots
};

}  // namespace plumescout::lab
