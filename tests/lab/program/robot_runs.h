// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "client/robot_view.h"
#include "formats/file_io.h"

namespace plumescout::lab {

// A file as a robot's own program records it.
inline void WriteRobotRun(const std::string& path, const std::vector<Observation>& log) {
  plumescout::GasSensor pid;  // of the mission, not of the simulation
  pid.id = "pid";
  client::RobotView view({.mission = "hall",
                          .robot = "scout",
                          .radius_m = 0.25,
                          .frame = {.mission_from_robot = {10.0, 0.0, 0.0}},
                          .sensors = {pid}},
                         /*time_ns=*/0);
  for (const Observation& seen : log) EXPECT_TRUE(view.Add(seen).ok());
  EXPECT_TRUE(view.Finish().ok());
  EXPECT_TRUE(WriteFile(path, view.Take()).ok());
}

}  // namespace plumescout::lab
