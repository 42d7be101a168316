// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/recorded_map.h"

#include "client/lag_correction.h"
#include "core/gas/gas_map.h"
#include "core/gas/way_readings.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {

std::vector<PlacedReading> AtPoints(const GasRecording& recording) {
  std::vector<PlacedReading> placed;
  client::LagCorrection correction(recording.response_time_s);
  for (const HeardPose& heard : recording.heard) {
    correction.NotePose(heard.time_ns, heard.pose);
    if (!heard.reading) continue;
    const client::GasSample air = correction.Correct({heard.time_ns, heard.pose, *heard.reading});
    placed.push_back({air.time_ns, air.pose.position(), air.reading});
  }
  return placed;
}

std::vector<PlacedReading> AlongWay(const GasRecording& recording, const GasOptions& gas) {
  const WayModel model{.response_time_s = recording.response_time_s,
                       .robot_from_sensor = {},
                       .resolution_m = recording.states.geometry().resolution_m,
                       .gas = gas};
  std::vector<PlacedReading> placed;
  const auto place = [&placed](const std::vector<AirReading>& told) {
    for (const AirReading& air : told) {
      placed.push_back({air.time_ns, air.pose.position(), air.reading});
    }
  };
  WayReadings way;
  for (const HeardPose& heard : recording.heard) {
    way.NotePose(heard.time_ns, heard.pose);
    if (heard.reading) place(way.Add(model, heard.time_ns, heard.pose, *heard.reading));
  }
  place(way.Finish(model));
  return placed;
}

absl::StatusOr<MapSnapshot> MapRecording(const GasRecording& recording,
                                         const std::vector<PlacedReading>& readings,
                                         const GasOptions& gas) {
  constexpr int kBatch = 20;  // readings between refreshes of a field that learns
  GasMap field(gas, recording.states.geometry().resolution_m);
  const std::int64_t end_ns = recording.heard.back().time_ns;
  const bool learns = gas.precisions == GasPrecisions::kLearned;
  int since_refresh = 0;
  for (const PlacedReading& placed : readings) {
    field.Add(placed.time_ns, placed.place, placed.reading);
    if (!learns || ++since_refresh < kBatch) continue;
    since_refresh = 0;
    PLUMESCOUT_RETURN_IF_ERROR(field.Refresh(recording.states, end_ns));
    if (!field.epoch_due(end_ns)) continue;
    PLUMESCOUT_RETURN_IF_ERROR(field.BeginEpoch(end_ns));
    PLUMESCOUT_RETURN_IF_ERROR(field.Adopt());
  }
  PLUMESCOUT_RETURN_IF_ERROR(field.Refresh(recording.states, end_ns));
  MapSnapshot map;
  map.occupancy = recording.states;
  map.gas_mean_ppm = field.mean_ppm();
  map.gas_variance_ppm2 = field.error_variance_ppm2();
  map.gas_quality = field.quality();
  return map;
}

}  // namespace plumescout::lab
