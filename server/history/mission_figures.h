// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "plumescout/v1/snapshot_service.pb.h"

namespace plumescout::server {

// The map of a mission that began at `begin_ns`, in sample time, in figures. Searches its
// frontiers: not for reactors.
v1::MissionFigures FiguresOf(const Belief& belief, const MissionId& mission, std::int64_t begin_ns);

}  // namespace plumescout::server
