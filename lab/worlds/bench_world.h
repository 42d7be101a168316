// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/grid.h"
#include "core/types/pose2.h"
#include "core/types/rng.h"
#include "core/types/scan.h"

namespace plumescout::lab {

// A building of `width` x `height` cells of 0.1 m: rooms with a door in each wall and a few boxes
// inside an outer wall. 1 where there is a wall.
Grid<std::uint8_t> MakeBuilding(int width, int height, std::uint64_t seed);

// What a lidar of 360 beams and 8 m sees at `pose`: exact ranges to the walls, +infinity beyond.
Scan ScanBuilding(const Grid<std::uint8_t>& walls, const Pose2& pose);

// `count` poses at the centres of cells that hold no wall.
std::vector<Pose2> FreePoses(const Grid<std::uint8_t>& walls, int count, std::uint64_t seed);

// Drives `step_m` straight on; if there is a wall on that way or `clear_m` beyond it, turns to a
// heading drawn at random first. Stays, turned, where fifty draws find no way.
void DriveOn(const Grid<std::uint8_t>& walls, double step_m, double clear_m, Rng& rng, Pose2& pose);

}  // namespace plumescout::lab
