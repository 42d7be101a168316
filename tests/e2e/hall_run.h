// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// One robot's mission in a small building with gas, and what is left of it to compare.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "client/planner_client.h"
#include "core/types/map_snapshot.h"
#include "lab/sim/episode.h"
#include "lab/sim/scene_world.h"
#include "server/server.h"

namespace plumescout::lab {

inline constexpr char kHallMission[] = "trial";

// See gas_hall.h. Made once.
const SceneWorld& GasHall();

// 40 simulated seconds in lockstep, with bounded work, so that only the planning service could make
// a difference.
EpisodeOptions HallOptions();

struct HallRun {
  EpisodeResult episode;
  MapSnapshot map;  // at the end
};

absl::StatusOr<HallRun> RunInHall(client::PlannerClient& planner, const EpisodeOptions& options);

// Free of what no two runs share: wall time, and the count of refreshes, which follows the batches.
std::vector<Plan> ComparablePlans(const EpisodeResult& episode);

// Whether two maps hold the same bytes in every raster, the same robots and counts.
bool SameMap(const MapSnapshot& a, const MapSnapshot& b);

// On a loopback port; 0: any.
std::unique_ptr<server::Server> StartServer(int port = 0, server::RegistryHooks hooks = {});
std::unique_ptr<client::PlannerClient> ClientOf(const server::Server& server);

// Shown every observation on its way to the service; what it returns goes on instead.
using ObservationTap = std::function<Observation(const Observation&)>;

// `inner` with a tap in its streams. `inner` must outlive it.
std::unique_ptr<client::PlannerClient> WithTap(client::PlannerClient& inner, ObservationTap tap);

// The observation as it comes out at the far end of the wire: ranges in steps of 5 mm.
Observation AsOnTheWire(const Observation& observation);

}  // namespace plumescout::lab
