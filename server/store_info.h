// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What callers are told of the store.
#pragma once

#include "plumescout/v1/system_service.pb.h"
#include "server/config/config.h"
#include "server/missions/stray_calls.h"
#include "server/store/mission_store.h"
#include "server/store_usage.h"

namespace plumescout::server {

// Both null where missions are not kept. Does not block.
v1::StoreInfo TellOfStore(const StoreConfig& config, const MissionStore* store,
                          const StoreUsage* usage, const StrayFigures& strays = {});

}  // namespace plumescout::server
