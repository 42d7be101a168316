// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/cell_state.h"
#include "core/types/event.h"
#include "core/types/gas_reading.h"
#include "core/types/grid.h"
#include "core/types/options.h"
#include "core/types/pose2.h"
#include "lab/sim/scene_world.h"

namespace plumescout::lab {

// What a mission heard of a robot: where it was and, if it read gas there, what its sensor showed.
struct HeardPose {
  std::int64_t time_ns = 0;
  Pose2 pose;
  std::optional<GasReading> reading;
};

// None if the event is no observation.
std::optional<HeardPose> HeardIn(const Event& event);

// A mission as its gas maps are made from it, so that several can be made from the same readings.
struct GasRecording {
  std::vector<HeardPose> heard;  // in the order of time
  Grid<CellState> states;        // of the map at the end
  double response_time_s = 0.0;  // of the sensor, whose lag nobody has undone
};

// One robot drives through the world, planned in this process; what it measured of scans and
// gas is kept. Planning goes by readings as the sensor shows them, unless the mission is left to
// undo its lag along the way. Errors: as RunEpisode.
absl::StatusOr<GasRecording> RecordGas(const SceneWorld& world, const MissionOptions& mission,
                                       std::uint64_t seed, double duration_s,
                                       bool mission_corrects_lag = false);

}  // namespace plumescout::lab
