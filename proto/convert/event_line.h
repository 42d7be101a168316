// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/types/event.h"
#include "core/types/ids.h"
#include "plumescout/v1/snapshot_service.pb.h"

namespace plumescout {

v1::MissionEventKind KindOf(const EventBody& body);

// What happened, in one line for people: "scan 12, 360 beams at (2.00, 1.50)".
std::string LineOf(const EventBody& body);

// The event as histories tell it.
v1::MissionEvent ToProto(const Event& event, const MissionId& mission);

}  // namespace plumescout
