// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/gas_reading.h"
#include "core/types/map_snapshot.h"
#include "core/types/options.h"
#include "core/types/pose2.h"
#include "lab/trials/gas_recording.h"

namespace plumescout::lab {

// What the air was like at a place, once the lag of the sensor is undone.
struct PlacedReading {
  std::int64_t time_ns = 0;
  Point2 place;
  GasReading reading;
};

// The lag undone as a robot does it: from each two readings, for one place between them.
std::vector<PlacedReading> AtPoints(const GasRecording& recording);
// As a mission does it: for each cell of the way.
std::vector<PlacedReading> AlongWay(const GasRecording& recording, const GasOptions& gas);

// The gas map of the readings in this field, over what the robot knew in the end: mean, published
// variance and quality; frontiers, robots and the like are empty. Fields that learn their
// precisions are refreshed in between, as in a mission. REQUIRES: something was heard. Errors: as
// GasMap::Refresh.
absl::StatusOr<MapSnapshot> MapRecording(const GasRecording& recording,
                                         const std::vector<PlacedReading>& readings,
                                         const GasOptions& gas);

}  // namespace plumescout::lab
