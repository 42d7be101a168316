// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/postgres_connection.h"
#include "server/store/store_nodes.h"

namespace plumescout::server {

// What nodes tell each other of calls that strayed: a row a mission, with the lease of its node
// when that was noted. Nothing that is written or acquired depends on it.

// As StoreNodes, for the node of this name.
absl::Status NoteSharedStrays(PostgresConnection& connection, const StrayRules& rules,
                              const std::string& self, const std::vector<OwnedMission>& missions);
// As StoreNodes, for the node of this lease.
absl::StatusOr<Strays> TakeSharedStrays(PostgresConnection& connection, const StrayRules& rules,
                                        std::int64_t lease, int limit);

}  // namespace plumescout::server
