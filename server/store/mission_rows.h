// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/database.h"
#include "server/store/mission_row.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// Missions in a database, row by row. Every row has a checksum, which reading checks: kDataLoss,
// naming file and row, if it is not what was written. Other errors as of Database.
class MissionRows {
 public:
  explicit MissionRows(Database* database) : database_(database) {}

  const std::string& file() const { return database_->path(); }

  absl::StatusOr<std::optional<MissionRow>> Find(const std::string& key);
  // Of all missions by key; rows that are damaged have a key only.
  absl::StatusOr<std::vector<MissionRow>> List();

  // Of a mission whose row may be damaged; nothing if there is none.
  absl::StatusOr<std::optional<std::int64_t>> FindId(const std::string& key);

  absl::StatusOr<std::string> Header(const MissionRow& row);
  absl::StatusOr<std::string> Standing(const MissionRow& row);
  // Of the records up to this one; 0 is the header. REQUIRES: number >= row.base.
  absl::StatusOr<std::uint32_t> ChainAt(const MissionRow& row, std::int64_t number);
  // Newest first. A damaged one is left out: what it held, the records tell too.
  absl::StatusOr<std::vector<StoredSnapshot>> Snapshots(const MissionRow& row);
  // How many are damaged.
  absl::StatusOr<int> CountDamagedSnapshots(const MissionRow& row);

  // Writing, within a transaction. What changes `row` needs Save afterwards.
  absl::StatusOr<MissionRow> Insert(const std::string& key, const std::string& header);
  absl::Status Save(MissionRow& row);
  absl::Status AddRecords(MissionRow& row, std::span<const std::string> records);
  absl::Status PutStanding(MissionRow& row, const std::string& standing);
  absl::Status PutSnapshot(MissionRow& row, const StoredSnapshot& snapshot);
  // Records up to the older one of two whole snapshots count no more, and stay for PurgeTrimmed.
  absl::Status Trim(MissionRow& row);
  // Its records stay for PurgeRemoved.
  absl::Status Delete(const MissionRow& row);
  // Deletes at most so many records of missions that were deleted. Whether some are left.
  absl::StatusOr<bool> PurgeRemoved(int max_records);
  // The same of records that were trimmed.
  absl::StatusOr<bool> PurgeTrimmed(int max_records);

  // Whether exactly these records stand behind the others of their numbers.
  absl::StatusOr<bool> HoldsRecords(const MissionRow& row, std::int64_t first_number,
                                    std::span<const std::string> records);

 private:
  absl::Status Damaged(const MissionRow& row, absl::string_view what) const;

  Database* const database_;
};

}  // namespace plumescout::server
