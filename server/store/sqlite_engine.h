// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "server/store/database.h"
#include "server/store/head_marks.h"
#include "server/store/mission_rows.h"
#include "server/store/store_folder.h"
#include "server/store/store_write.h"

namespace plumescout::server {

struct SqliteEngineOptions {
  std::string folder;
  bool accept_loss = false;  // see StoreOptions
  std::function<void(absl::string_view)> warn = [](absl::string_view) {};
};

// Writes to a database in SQLite, in a folder of its own. After an error it goes on with a new
// connection, which reads what the disk holds, so nothing that was half done is believed.
class SqliteEngine final : public WriteEngine {
 public:
  // Makes the folder and the database unless they stand. Errors: of FolderLock, CheckDatabaseFile
  // and Database.
  static absl::StatusOr<std::unique_ptr<SqliteEngine>> Open(const SqliteEngineOptions& options);

  // A batch without writes is a chore, or else changes a row of its own.
  absl::Status Commit(std::span<StoreWrite> writes) override;
  // Brings the write-ahead log into the database once it is long enough, or a mission is removed.
  void Tidy() override;
  bool has_chores() const override { return has_chores_; }

  const std::string& file() const { return file_; }
  const HeadMarks& marks() const { return *marks_; }

 private:
  SqliteEngine(const SqliteEngineOptions& options, FolderLock lock,
               std::unique_ptr<HeadMarks> marks);

  absl::Status Connect();
  absl::Status AcceptLoss();
  absl::Status CommitConnected(std::span<StoreWrite> writes);
  // An error undoes the batch; what only this write asks in vain is its `result`.
  absl::Status Apply(StoreWrite& write);
  absl::Status ApplyTo(MissionRow& row, StoreWrite& write);
  absl::Status Create(StoreWrite& write);
  absl::Status UndoCreate(const StoreWrite& write);
  absl::Status Acquire(StoreWrite& write);
  absl::Status Append(MissionRow& row, StoreWrite& write);
  absl::Status Remove(const MissionRow& row);
  absl::Status Discard(StoreWrite& write);
  absl::Status Compact(StoreWrite& write);
  absl::Status DoChore();
  absl::Status Save(MissionRow& row);
  void MarkHeads();

  const SqliteEngineOptions options_;
  const FolderLock lock_;
  const std::string file_;
  const std::unique_ptr<HeadMarks> marks_;

  std::unique_ptr<Database> database_;  // null after an error
  std::unique_ptr<MissionRows> rows_;   // of the database
  // The last commit may have reached the disk in part, however the database looks now.
  bool is_uncertain_ = false;
  bool has_chores_ = true;  // until none is found
  bool is_compacted_ = false;
  bool has_removed_ = false;  // a mission, which is back if the log loses its end: it has no mark
  bool warned_of_marks_ = false;
  std::map<std::string, MissionRow> saved_;  // in this transaction
};

}  // namespace plumescout::server
