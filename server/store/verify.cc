// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/verify.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/database.h"
#include "server/store/head_marks.h"
#include "server/store/mission_check.h"
#include "server/store/mission_rows.h"
#include "server/store/schema.h"
#include "server/store/sqlite_reader.h"
#include "server/store/store_folder.h"

namespace plumescout::server {
namespace {

// Reads the mission from end to end.
absl::Status VerifyMission(const std::string& file, MissionRows& rows, const HeadMarks& marks,
                           MissionReport& report) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const CheckedMission mission,
                              LoadMission(rows, marks.Known(report.key), report.key));
  report.epoch = mission.row.epoch;
  report.head = mission.row.head;
  report.bytes = mission.row.bytes;
  report.snapshots = static_cast<int>(mission.known.snapshots.size());
  PLUMESCOUT_ASSIGN_OR_RETURN(report.damaged_snapshots, rows.CountDamagedSnapshots(mission.row));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto reader,
                              SqliteReader::Open(file, report.key, mission.known.first));
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<JournalRecord> record, reader->Next());
    if (!record.has_value()) return absl::OkStatus();
    ++report.records;
  }
}

absl::Status CheckIntegrity(Database& database, StoreReport& report) {
  Query query = database.Use("PRAGMA integrity_check");
  while (true) {
    const absl::StatusOr<bool> has_row = query.Next();
    if (absl::IsDataLoss(has_row.status())) {
      report.faults.emplace_back(has_row.status().message());
      return absl::OkStatus();
    }
    PLUMESCOUT_RETURN_IF_ERROR(has_row.status());
    if (!*has_row) return absl::OkStatus();
    const std::string said = query.Bytes(0);
    if (said != "ok") report.faults.push_back(absl::StrCat(report.file, ": ", said));
  }
}

// Of the database and of the marks.
absl::StatusOr<std::set<std::string>> Keys(MissionRows& rows, const HeadMarks& marks) {
  std::set<std::string> keys;
  for (const HeadMark& mark : marks.All()) keys.insert(mark.key);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<MissionRow> found, rows.List());
  for (const MissionRow& row : found) keys.insert(row.key);
  return keys;
}

}  // namespace

bool StoreReport::is_whole() const {
  return faults.empty() && std::all_of(missions.begin(), missions.end(),
                                       [](const MissionReport& one) { return one.is_whole(); });
}

absl::StatusOr<StoreReport> VerifyStore(const std::string& folder, const VerifyProgress& progress) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const FolderLock lock, FolderLock::TakeExisting(folder));
  StoreReport report;
  report.file = DatabaseFile(folder);
  PLUMESCOUT_RETURN_IF_ERROR(CheckDatabaseFile(report.file));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto database,
                              Database::Open(report.file, Database::Access::kRead));
  PLUMESCOUT_RETURN_IF_ERROR(CheckSchema(*database));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto marks, HeadMarks::OpenToRead(HeadMarksFile(folder)));
  if (marks->damaged_slots() > 0) {
    report.faults.push_back(
        absl::StrCat(marks->path(), ": ", marks->damaged_slots(), " damaged slots"));
  }
  progress("the structure of the database", 0, 1);
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntegrity(*database, report));
  MissionRows rows(database.get());
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::set<std::string> keys, Keys(rows, *marks));
  std::int64_t done = 0;
  for (const std::string& key : keys) {
    progress(absl::StrCat("mission ", absl::CHexEscape(key)), done++,
             static_cast<std::int64_t>(keys.size()));
    MissionReport mission;
    mission.key = key;
    mission.status = VerifyMission(report.file, rows, *marks, mission);
    if (!mission.status.ok() && !absl::IsDataLoss(mission.status)) return mission.status;
    report.missions.push_back(std::move(mission));
  }
  return report;
}

}  // namespace plumescout::server
