// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/config/config.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// Whether this server was built with what store.engine = postgresql needs.
bool HasPostgresql();

// The store that the configuration asks for; null for none. An error names the folder, and what is
// wrong with it: no rights, another server in it, a newer format, another program's files. Of a
// database it names the host, never the password. `listen`: where others reach this server, if
// store.advertise does not say.
absl::StatusOr<std::unique_ptr<MissionStore>> OpenStore(const StoreConfig& config,
                                                        const std::string& listen = "");

}  // namespace plumescout::server
