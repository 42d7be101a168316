// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/strings/string_view.h"
#include "core/types/cell_state.h"
#include "core/types/frontier.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"
#include "core/types/trajectory.h"
#include "foxglove/schemas.pb.h"

namespace plumescout {

// What Foxglove draws (proto/foxglove/schemas.proto), in frame `map`. `time_ns` is since the Unix
// epoch, and not negative.

foxglove::PoseInFrame FoxglovePose(const Pose2& pose, std::int64_t time_ns);
// `pose` is that of the robot. Ranges are rounded by at most 4 mm, so that they pack into a third
// of the bytes: for looking.
foxglove::LaserScan FoxgloveScan(const Scan& scan, const Pose2& pose, std::int64_t time_ns);

// A field "occupancy" as ROS has it: -1 unknown, 0 free, 100 occupied.
foxglove::Grid FoxgloveGrid(const Grid<CellState>& occupancy, std::int64_t time_ns);
// A field of that name, each value rounded by at most 0.1 % of the largest one, so that it packs
// into a fraction of the bytes: for looking, not for going on with. NaN stays NaN.
foxglove::Grid FoxgloveGrid(const Grid<float>& values, absl::string_view name,
                            std::int64_t time_ns);

// The way of a plan as a line with its goal, and its end; one entity of that id.
foxglove::SceneUpdate FoxgloveWay(absl::string_view id, const Trajectory& trajectory,
                                  std::int64_t time_ns);
foxglove::SceneUpdate FoxgloveGone(absl::string_view id, std::int64_t time_ns);
// An entity for each kind; those that are no goals are paler. Of more cells than kMostFrontierMarks
// every second one is shown, or every third, and so on.
inline constexpr std::size_t kMostFrontierMarks = 20'000;
foxglove::SceneUpdate FoxgloveFrontiers(const std::vector<Frontier>& frontiers,
                                        const GridGeometry& geometry, std::int64_t time_ns);

// `name` is who it is about.
foxglove::Log FoxgloveLog(foxglove::Log::Level level, absl::string_view name,
                          absl::string_view message, std::int64_t time_ns);

}  // namespace plumescout
