// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/sqlite_engine.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "absl/memory/memory.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/mission_check.h"
#include "server/store/schema.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

using Kind = StoreWrite::Kind;

constexpr int kCheckpointPages = 1000;  // 16 MB
constexpr int kPurgedRecords = 500;     // in one chore

HeadMark MarkOf(const MissionRow& row) {
  return {row.key, row.epoch, row.head, row.chain, row.writes};
}

}  // namespace

absl::StatusOr<std::unique_ptr<SqliteEngine>> SqliteEngine::Open(
    const SqliteEngineOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(FolderLock lock, FolderLock::Take(options.folder));
  const std::string file = DatabaseFile(options.folder);
  if (!FileExists(file)) PLUMESCOUT_RETURN_IF_ERROR(MakeDatabase(file));
  PLUMESCOUT_RETURN_IF_ERROR(CheckDatabaseFile(file));
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<HeadMarks> marks,
                              HeadMarks::Open(HeadMarksFile(options.folder)));
  if (marks->damaged_slots() > 0) {
    options.warn(
        absl::StrCat(marks->path(), ": ", marks->damaged_slots(), " damaged slots are left aside"));
  }
  auto engine = absl::WrapUnique(new SqliteEngine(options, std::move(lock), std::move(marks)));
  PLUMESCOUT_RETURN_IF_ERROR(engine->Connect());
  PLUMESCOUT_RETURN_IF_ERROR(UpdateSchema(*engine->database_));
  if (options.accept_loss) PLUMESCOUT_RETURN_IF_ERROR(engine->AcceptLoss());
  return engine;
}

SqliteEngine::SqliteEngine(const SqliteEngineOptions& options, FolderLock lock,
                           std::unique_ptr<HeadMarks> marks)
    : options_(options),
      lock_(std::move(lock)),
      file_(DatabaseFile(options.folder)),
      marks_(std::move(marks)) {}

absl::Status SqliteEngine::Connect() {
  PLUMESCOUT_ASSIGN_OR_RETURN(auto database, Database::Open(file_, Database::Access::kWrite));
  if (is_uncertain_) {
    // The system may take for written what the disk refused: only what is written anew counts.
    PLUMESCOUT_RETURN_IF_ERROR(database->Checkpoint(/*whole=*/true));
    is_uncertain_ = false;
  }
  database_ = std::move(database);
  rows_ = std::make_unique<MissionRows>(database_.get());
  return absl::OkStatus();
}

absl::Status SqliteEngine::AcceptLoss() {
  Transaction transaction(database_.get());
  PLUMESCOUT_RETURN_IF_ERROR(transaction.Begin());
  std::vector<HeadMark> marks;
  std::vector<std::string> gone;
  for (const HeadMark& mark : marks_->All()) {
    absl::StatusOr<std::optional<MissionRow>> row = rows_->Find(mark.key);
    if (absl::IsDataLoss(row.status())) continue;  // damage that no mark makes good
    PLUMESCOUT_RETURN_IF_ERROR(row.status());
    const KnownHead known{marks_->path(), mark};
    const absl::Status status = row->has_value() ? CheckAgainstMark(*rows_, **row, known)
                                                 : WhyAbsent(mark.key, file_, known);
    if (status.ok()) continue;
    if (!absl::IsDataLoss(status)) return status;
    options_.warn(absl::StrCat("accepted: ", status.message()));
    if (!row->has_value()) {
      gone.push_back(mark.key);
      continue;
    }
    // Nothing that was given out under a lost epoch may be given out again.
    (*row)->epoch = std::max((*row)->epoch, mark.epoch);
    (*row)->writes = std::max((*row)->writes, mark.writes);
    PLUMESCOUT_RETURN_IF_ERROR(rows_->Save(**row));
    marks.push_back(MarkOf(**row));
  }
  PLUMESCOUT_RETURN_IF_ERROR(transaction.Commit());
  for (const HeadMark& mark : marks) PLUMESCOUT_RETURN_IF_ERROR(marks_->Set(mark));
  for (const std::string& key : gone) PLUMESCOUT_RETURN_IF_ERROR(marks_->Clear(key));
  return absl::OkStatus();
}

absl::Status SqliteEngine::Commit(std::span<StoreWrite> writes) {
  if (database_ == nullptr) PLUMESCOUT_RETURN_IF_ERROR(Connect());
  saved_.clear();
  const absl::Status status = CommitConnected(writes);
  if (status.ok()) {
    MarkHeads();
    return status;
  }
  if (absl::IsUnavailable(status) && !database_->was_full()) is_uncertain_ = true;
  rows_ = nullptr;
  database_ = nullptr;
  if (writes.empty() && !absl::IsUnavailable(status)) has_chores_ = false;  // it would fail again
  return status;
}

absl::Status SqliteEngine::CommitConnected(std::span<StoreWrite> writes) {
  Transaction transaction(database_.get());
  PLUMESCOUT_RETURN_IF_ERROR(transaction.Begin());
  for (StoreWrite& write : writes) {
    write.result = absl::OkStatus();
    PLUMESCOUT_RETURN_IF_ERROR(Apply(write));
  }
  if (writes.empty()) PLUMESCOUT_RETURN_IF_ERROR(DoChore());
  return transaction.Commit();
}

absl::Status SqliteEngine::Apply(StoreWrite& write) {
  switch (write.kind) {
    case Kind::kCreate:
      return Create(write);
    case Kind::kUndoCreate:
      return UndoCreate(write);
    case Kind::kAcquire:
      return Acquire(write);
    case Kind::kDiscard:
      return Discard(write);
    case Kind::kCompact:
      return Compact(write);
    case Kind::kAppend:
    case Kind::kStanding:
    case Kind::kSnapshot:
    case Kind::kTrim:
    case Kind::kRemove:
      break;
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(std::optional<MissionRow> row, rows_->Find(write.key));
  if (!row.has_value()) {
    const bool is_done = write.kind == Kind::kRemove && write.tried;
    if (!is_done) write.result = NotStored(write.key);
    return absl::OkStatus();
  }
  if (row->epoch != write.epoch) {
    write.result = FencedByEpoch(write.key, write.epoch, row->epoch);
    return absl::OkStatus();
  }
  return ApplyTo(*row, write);
}

absl::Status SqliteEngine::ApplyTo(MissionRow& row, StoreWrite& write) {
  if (write.kind == Kind::kAppend) return Append(row, write);
  if (write.kind == Kind::kRemove) return Remove(row);
  if (write.kind == Kind::kStanding) {
    PLUMESCOUT_RETURN_IF_ERROR(rows_->PutStanding(row, write.bytes));
    return Save(row);
  }
  if (write.kind == Kind::kTrim) {
    PLUMESCOUT_RETURN_IF_ERROR(rows_->Trim(row));
    has_chores_ = true;
    return Save(row);
  }
  if (write.snapshot.revision > row.head) {
    write.result = SnapshotAhead(write.key, write.snapshot.revision, row.head);
    return absl::OkStatus();
  }
  PLUMESCOUT_RETURN_IF_ERROR(rows_->PutSnapshot(row, write.snapshot));
  return Save(row);
}

absl::Status SqliteEngine::Create(StoreWrite& write) {
  write.inserted = false;
  if (write.key.empty() || write.key.size() > kMaxMissionKeyBytes) {
    write.result = absl::InvalidArgumentError(
        absl::StrCat("a key of ", write.key.size(), " bytes, not 1 to ", kMaxMissionKeyBytes));
    return absl::OkStatus();
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<MissionRow> row, rows_->Find(write.key));
  const bool is_lost = !row.has_value() && marks_->Find(write.key).has_value();
  if (row.has_value()) write.result = AlreadyStored(write.key);
  if (is_lost) write.result = WhyAbsent(write.key, file_, marks_->Known(write.key));
  if (!write.result.ok()) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(const MissionRow made, rows_->Insert(write.key, write.bytes));
  write.inserted = true;
  saved_[made.key] = made;
  return absl::OkStatus();
}

absl::Status SqliteEngine::UndoCreate(const StoreWrite& write) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<MissionRow> row, rows_->Find(write.key));
  if (!row.has_value() || row->epoch > 1 || row->head > 0) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string header, rows_->Header(*row));
  return header == write.bytes ? Remove(*row) : absl::OkStatus();
}

absl::Status SqliteEngine::Acquire(StoreWrite& write) {
  absl::StatusOr<CheckedMission> mission = LoadMission(*rows_, marks_->Known(write.key), write.key);
  if (absl::IsNotFound(mission.status())) {
    write.result = mission.status();
    return absl::OkStatus();
  }
  PLUMESCOUT_RETURN_IF_ERROR(mission.status());
  mission->known.epoch = ++mission->row.epoch;
  PLUMESCOUT_RETURN_IF_ERROR(Save(mission->row));
  if (write.acquired != nullptr) *write.acquired = std::move(mission->known);
  return absl::OkStatus();
}

absl::Status SqliteEngine::Append(MissionRow& row, StoreWrite& write) {
  if (write.first_number == row.head + 1) {
    PLUMESCOUT_RETURN_IF_ERROR(rows_->AddRecords(row, write.records));
    return Save(row);
  }
  bool is_done = false;
  if (write.tried) {
    PLUMESCOUT_ASSIGN_OR_RETURN(is_done,
                                rows_->HoldsRecords(row, write.first_number, write.records));
  }
  if (!is_done) write.result = FencedByHead(write.key, write.first_number, row.head);
  saved_[row.key] = row;  // its mark may be behind
  return absl::OkStatus();
}

absl::Status SqliteEngine::Remove(const MissionRow& row) {
  PLUMESCOUT_RETURN_IF_ERROR(marks_->Clear(row.key));
  saved_.erase(row.key);
  has_chores_ = true;
  has_removed_ = true;
  return rows_->Delete(row);
}

absl::Status SqliteEngine::Discard(StoreWrite& write) {
  const absl::Status status = LoadMission(*rows_, marks_->Known(write.key), write.key).status();
  if (absl::IsNotFound(status) && write.tried) return absl::OkStatus();
  if (status.ok() || absl::IsNotFound(status)) {
    write.result = status.ok() ? NotDamaged(write.key) : status;
    return absl::OkStatus();
  }
  if (!absl::IsDataLoss(status)) return status;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<std::int64_t> id, rows_->FindId(write.key));
  if (!id.has_value()) return marks_->Clear(write.key);  // it was there once
  MissionRow row;
  row.key = write.key;
  row.id = *id;
  return Remove(row);
}

absl::Status SqliteEngine::Compact(StoreWrite& write) {
  PLUMESCOUT_RETURN_IF_ERROR(database_->Use("PRAGMA incremental_vacuum(256)").Run());
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t left, database_->GetInt("PRAGMA freelist_count"));
  if (write.left != nullptr) *write.left = left;
  is_compacted_ = left == 0;
  return absl::OkStatus();
}

absl::Status SqliteEngine::DoChore() {
  if (has_chores_) {
    PLUMESCOUT_ASSIGN_OR_RETURN(has_chores_, rows_->PurgeRemoved(kPurgedRecords));
    if (!has_chores_) {
      PLUMESCOUT_ASSIGN_OR_RETURN(has_chores_, rows_->PurgeTrimmed(kPurgedRecords));
    }
  }
  if (has_chores_) return absl::OkStatus();
  return database_->Use("UPDATE probe SET count = count + 1").Run();
}

absl::Status SqliteEngine::Save(MissionRow& row) {
  PLUMESCOUT_RETURN_IF_ERROR(rows_->Save(row));
  saved_[row.key] = row;
  return absl::OkStatus();
}

void SqliteEngine::MarkHeads() {
  absl::Status status;
  for (const auto& [key, row] : saved_) status.Update(marks_->Set(MarkOf(row)));
  if (!status.ok() && !warned_of_marks_) options_.warn(status.message());
  warned_of_marks_ = !status.ok();
}

void SqliteEngine::Tidy() {
  if (database_ == nullptr) return;
  const bool is_long = database_->logged_pages() >= kCheckpointPages;
  if (!is_long && !is_compacted_ && !has_removed_) return;
  const absl::Status status = database_->Checkpoint(/*whole=*/is_compacted_ || has_removed_);
  is_compacted_ = false;
  has_removed_ = false;
  // The log holds everything still; who writes next hears of a disk that is really ill.
  if (!status.ok()) options_.warn(status.message());
}

}  // namespace plumescout::server
