// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "core/belief/belief.h"

namespace plumescout::lab {

struct MidMissionOptions {
  int width_cells = 160;  // of 0.1 m
  int height_cells = 200;
  int robots = 1;
  int rounds = 12;  // of four seconds; then all have planned so often
  std::uint64_t seed = 1;
};

// What a plan is asked for on.
struct PlanMoment {
  std::shared_ptr<const Belief> belief;
  RobotId robot;
};

// A mission in a building (MakeBuilding) of which the southern half is known from a floor plan, as
// the server runs it: robots that scan and smell three plumes drive by plans of the default
// strategy, in turn. Returns what each plan of the later half of the rounds was made on.
absl::StatusOr<std::vector<PlanMoment>> RunToMidMission(const MidMissionOptions& options);

}  // namespace plumescout::lab
