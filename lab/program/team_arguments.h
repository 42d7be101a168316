// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "absl/status/statusor.h"
#include "lab/sim/episode.h"

namespace plumescout::lab {

// What of the command line sets robots of a team apart and befalls them. Lists of numbers have one
// for each robot, in order, and begin again if there are fewer; others name the robot, from 1.
struct TeamArguments {
  std::vector<double> speeds_mps;
  std::vector<double> clock_offsets_s;
  std::vector<double> clock_drifts_ppm;
  std::vector<std::string> dropouts;     // WHO:AT[:FOR]
  std::vector<std::string> leaves;       // WHO:AT[:FOR]
  std::vector<std::string> link_losses;  // WHO:AT:FOR
  std::vector<std::string> pose_jumps;   // WHO:AT:METRES:DEGREES[:AFTER]
};

// `arguments` must outlive the parsing.
void AddTeamOptions(CLI::App& app, TeamArguments& arguments);

// Whether any clock is to be wrong.
bool HasWrongClocks(const TeamArguments& arguments);

// Of each robot. kInvalidArgument, naming option and value: what does not parse, robots that are
// not there, more values than robots, speeds that are not above 0, outages of a robot that overlap.
absl::StatusOr<std::vector<RobotTraits>> MakeTraits(const TeamArguments& arguments, int robots);

}  // namespace plumescout::lab
