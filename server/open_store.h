// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "server/config/config.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// The store that the configuration asks for; null for none. An error names the folder, and what is
// wrong with it: no rights, another server in it, a newer format, another program's files.
absl::StatusOr<std::unique_ptr<MissionStore>> OpenStore(const StoreConfig& config);

}  // namespace plumescout::server
