// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/store_list.h"

#include "core/types/status_macros.h"
#include "server/store/database.h"
#include "server/store/mission_rows.h"
#include "server/store/schema.h"
#include "server/store/store_folder.h"

namespace plumescout::server {

absl::StatusOr<std::vector<StoredMission>> ListStore(const std::string& folder) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const FolderLock lock, FolderLock::TakeExisting(folder));
  const std::string file = DatabaseFile(folder);
  PLUMESCOUT_RETURN_IF_ERROR(CheckDatabaseFile(file));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto database, Database::Open(file, Database::Access::kRead));
  PLUMESCOUT_RETURN_IF_ERROR(CheckSchema(*database));
  MissionRows rows(database.get());
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<MissionRow> found, rows.List());
  std::vector<StoredMission> missions;
  for (const MissionRow& row : found) missions.push_back({row.key, row.epoch, row.head, row.bytes});
  return missions;
}

}  // namespace plumescout::server
