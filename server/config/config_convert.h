// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "plumescout/config/v1/server_config.pb.h"
#include "server/config/config.h"

namespace plumescout::server {

// Every field set, but those of missions that are off and what there is none of.
config::v1::ServerConfig ServerConfigToProto(const ServerConfig& config);

// The defaults with the fields that are set in `proto`. The result is valid; refusals begin with
// the option's name.
absl::StatusOr<ServerConfig> ServerConfigFromProto(const config::v1::ServerConfig& proto);

}  // namespace plumescout::server
