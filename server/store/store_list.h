// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// The missions of a store on which no server runs, by key. Changes nothing. Errors as VerifyStore.
absl::StatusOr<std::vector<StoredMission>> ListStore(const std::string& folder);

}  // namespace plumescout::server
