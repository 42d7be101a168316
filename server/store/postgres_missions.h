// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/mission_row.h"
#include "server/store/mission_store.h"
#include "server/store/postgres_connection.h"

namespace plumescout::server {

// How a mission stands in the database, and whose it is.
struct SharedRow {
  MissionRow row;
  std::int64_t owner = 0;   // the lease of a node, living or not; 0: nobody's
  std::string living_node;  // the name of that node; empty if its lease has run out
  std::int64_t standing_bytes = 0;
};

// What stands in the row of a mission that may be damaged.
struct DamagedRow {
  std::int64_t id = 0;
  bool has_progress = false;  // without it there is nothing of the next four
  std::int64_t epoch = 0;
  std::int64_t head = 0;
  std::int64_t writes = 0;
  std::int64_t crc = 0;
};

// A mission with all that is kept beside its records, checked.
struct SharedMission {
  SharedRow shared;
  AcquiredMission known;
};

// Whatever has a checksum is checked: kDataLoss, naming database and row. Other errors as
// of PostgresConnection. What one call reads is of a single state of the database.

// Of those of the keys that there are; kDataLoss in place of a row that is damaged.
absl::StatusOr<std::map<std::string, absl::StatusOr<SharedRow>>> LoadSharedRows(
    PostgresConnection& connection, std::span<const std::string> keys);
// kNotFound.
absl::StatusOr<SharedMission> LoadSharedMission(PostgresConnection& connection,
                                                const std::string& key);
// kNotFound; kFailedPrecondition of a mission that is not damaged; MISSION_ELSEWHERE if a node that
// lives has it, and not under this lease.
absl::StatusOr<DamagedRow> LoadDamagedRow(PostgresConnection& connection, const std::string& key,
                                          std::int64_t lease);
// All of them by key, and damaged rows with a key only.
absl::StatusOr<std::vector<StoredMission>> ListSharedMissions(PostgresConnection& connection);

// The checksums of the records up to each of these; 0 is the header. kDataLoss if one is not there.
absl::StatusOr<std::vector<std::uint32_t>> SharedChainsAt(PostgresConnection& connection,
                                                          const MissionRow& row,
                                                          std::span<const std::int64_t> numbers);
// Whether exactly these records stand behind the others of their numbers.
absl::StatusOr<bool> SharedHoldsRecords(PostgresConnection& connection, const MissionRow& row,
                                        std::int64_t first_number,
                                        std::span<const std::string> records);
// Revisions and sizes, newest first.
absl::StatusOr<std::vector<std::pair<std::int64_t, std::int64_t>>> SharedSnapshotSizes(
    PostgresConnection& connection, const MissionRow& row);
// Of the records after the first, up to the last.
absl::StatusOr<std::int64_t> SharedRecordBytes(PostgresConnection& connection,
                                               const MissionRow& row, std::int64_t after,
                                               std::int64_t last);
absl::StatusOr<std::int64_t> NextSharedId(PostgresConnection& connection);

absl::Status SharedRowDamaged(const PostgresConnection& connection, absl::string_view key,
                              absl::string_view what);

}  // namespace plumescout::server
