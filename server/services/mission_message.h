// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/types/options.h"
#include "plumescout/v1/mission_service.pb.h"
#include "server/missions/mission_host.h"
#include "server/missions/recovery_list.h"
#include "server/store/store_nodes.h"

namespace plumescout::server {

MissionOptions WithoutPriorMap(MissionOptions options);

// What a mission is now. `options`: those of the mission, as much of them as is to be told.
// `node`: the server's name among those that share its store.
v1::Mission DescribeMission(MissionHost& host, const MissionOptions& options,
                            const std::string& node = {});
v1::Mission DescribeMission(const AbsentMission& absent, const std::string& node = {});
// One that the server does not have.
v1::Mission DescribeMission(const OwnedMission& owned);

}  // namespace plumescout::server
