// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "client/planner_client.h"
#include "plumescout/v1/ingest_service.pb.h"

namespace plumescout::client {

IngestState StateFromProto(const v1::IngestState& proto);
v1::OpenIngest OpeningOf(const RobotSession& session);

}  // namespace plumescout::client
