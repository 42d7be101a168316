// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "client/mission_details.h"
#include "client/mission_history.h"
#include "plumescout/v1/mission_service.pb.h"
#include "plumescout/v1/snapshot_service.pb.h"

namespace plumescout::client {

// kInvalidArgument naming the field.
absl::StatusOr<MissionDetails> DetailsFromProto(const v1::Mission& proto);
absl::StatusOr<MissionEvent> EventFromProto(const v1::MissionEvent& proto);
absl::StatusOr<MissionFigures> FiguresFromProto(const v1::MissionFigures& proto);

v1::EventRetention ToProto(EventRetention retention);
v1::MissionEventKind ToProto(MissionEventKind kind);

}  // namespace plumescout::client
