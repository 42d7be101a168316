// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "server/base/fair_pool.h"
#include "server/calls/service_context.h"
#include "server/config/config.h"
#include "server/history/mission_import.h"
#include "server/missions/mission_maker.h"
#include "server/missions/mission_recording.h"

namespace plumescout::server {

// What the configuration says of missions, and of calls.
RegistryOptions ToRegistryOptions(const ServerConfig& config, std::int64_t first_lease_token);
ImportLimits ToImportLimits(const ServerConfig& config);
RecordingOptions ToRecordingOptions(const RecordConfig& config);
ServiceLimits ToServiceLimits(const ServerConfig& config);
FairPoolOptions ToPlanningPoolOptions(const PlanningConfig& config);
// Of callers who ask at the same time each has its turns; they have what robots leave of the CPU.
FairPoolOptions ToViewersPoolOptions(const std::string& name, int threads, const MapConfig& config);

}  // namespace plumescout::server
