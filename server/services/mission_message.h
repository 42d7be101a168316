// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/options.h"
#include "plumescout/v1/mission_service.pb.h"
#include "server/missions/mission_host.h"
#include "server/missions/recovery_list.h"

namespace plumescout::server {

MissionOptions WithoutPriorMap(MissionOptions options);

// What a mission is now. `options`: those of the mission, as much of them as is to be told.
v1::Mission DescribeMission(MissionHost& host, const MissionOptions& options);
v1::Mission DescribeMission(const AbsentMission& absent);

}  // namespace plumescout::server
