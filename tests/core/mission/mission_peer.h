// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/mission/mission.h"
#include "tests/core/gas/gas_map_peer.h"

namespace plumescout {

struct MissionPeer {
  static GasMap& Gas(Mission& mission) { return mission.gas_[0]; }
};

}  // namespace plumescout
