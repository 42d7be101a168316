// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/types/options.h"

namespace plumescout {

struct MissionVariant {
  std::string name;
  MissionOptions options;
};

// Missions that differ in what they keep, and in how they make a field of readings. Their cells are
// large, so that they are quickly tried.
inline std::vector<MissionVariant> MissionVariants() {
  MissionOptions plain;
  plain.occupancy.resolution_m = 0.2;

  MissionOptions several = plain;  // whose sensors may have offsets
  several.gas_species = {{"methane", {}, {}, {}, {}}, {"hydrogen-sulfide", 8.0, 20.0, 0.01, 1.0}};
  several.robot_silence_s = 20.0;
  several.max_robot_count = 3;
  several.objective.kind = ObjectiveKind::kFindSources;
  several.objective.threshold_ppm = 20.0;

  MissionOptions everything = several;
  everything.gas.scale = GasScale::kSquareRoot;
  everything.gas.precisions = GasPrecisions::kLearned;
  everything.gas.observation_stddev_share = 0.3;
  everything.objective.kind = ObjectiveKind::kMapAboveThreshold;
  everything.objective.deadline_s = 60.0;
  everything.return_home_below_battery_share = 0.3;
  everything.stamp_by_arrival = true;
  everything.keep_out = {{{{0.0, 0.0}, {0.4, 0.0}, {0.0, 0.4}}}};
  everything.home = Point2{1.0, 1.0};

  MissionOptions ageing = several;
  ageing.gas.ageing_half_life_s = 5.0;
  ageing.gas.lattice_factor = 2;
  ageing.gas.field_reach_m = 1.0;
  ageing.objective.kind = ObjectiveKind::kConfirmClean;
  ageing.objective.hold_s = 0.0;

  MissionOptions published;
  published.gas = PublishedGasOptions();
  published.occupancy = PublishedOccupancyOptions();
  published.occupancy.resolution_m = 0.2;

  return {{"default", plain},
          {"several gases", several},
          {"everything", everything},
          {"ageing", ageing},
          {"published", published}};
}

}  // namespace plumescout
