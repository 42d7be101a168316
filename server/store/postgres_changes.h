// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "server/store/mission_row.h"
#include "server/store/mission_store.h"
#include "server/store/postgres_connection.h"
#include "server/store/postgres_missions.h"

namespace plumescout::server {

// What changes the missions of a shared store.
//
// Each statement does what it says only if the mission's row still is `before`, epoch,
// head and all, and then makes it `after`; it gives one number: 1, or 0 if it was another and
// nothing was done. `after` has its writes counted up. Who becomes the owner must hold its lease.

PostgresStatement CreateStatement(const MissionRow& made, const std::string& header,
                                  std::int64_t owner);
// Nor if a node that has not been forgotten, and is not `owner`, has it. See ForgetStatement.
PostgresStatement AcquireStatement(const MissionRow& before, const MissionRow& after,
                                   std::int64_t owner);
PostgresStatement AppendStatement(const MissionRow& before, const MissionRow& after,
                                  std::span<const std::string> records);
PostgresStatement StandingStatement(const MissionRow& before, const MissionRow& after,
                                    const std::string& standing);
PostgresStatement SnapshotStatement(const MissionRow& before, const MissionRow& after,
                                    const StoredSnapshot& snapshot,
                                    std::span<const std::int64_t> leaving);
// Forgets a node whose lease has run out. It cannot be renewed any more then; one that is being
// renewed just now is waited for.
PostgresStatement ForgetStatement(std::int64_t lease);
PostgresStatement SaveStatement(const MissionRow& before, const MissionRow& after);
PostgresStatement RemoveStatement(const MissionRow& before);
// As the last, of a row that cannot be told by its checksum. Nor if a node that lives, and is not
// `owner`, has it.
PostgresStatement DiscardStatement(const DamagedRow& before, std::int64_t owner);
// Each of the first two deletes at most `limit` records and counts them: of missions that were
// removed, and of those that were trimmed. Other servers may be at it, too. Then missions are
// forgotten of which no record is left.
std::vector<PostgresStatement> PurgeStatements(std::int64_t limit);

}  // namespace plumescout::server
