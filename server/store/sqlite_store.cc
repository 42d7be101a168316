// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/sqlite_store.h"

#include <map>
#include <utility>

#include "absl/memory/memory.h"
#include "core/types/status_macros.h"
#include "server/store/database.h"
#include "server/store/mission_check.h"
#include "server/store/mission_rows.h"
#include "server/store/sqlite_engine.h"
#include "server/store/sqlite_reader.h"
#include "server/store/store_folder.h"

namespace plumescout::server {
namespace {

CommitterOptions ToCommitterOptions(const StoreOptions& options) {
  CommitterOptions committer;
  committer.max_batch_records = options.max_batch_records;
  committer.max_batch_bytes = options.max_batch_bytes;
  committer.retry_period = options.retry_period;
  committer.slow_commit = options.slow_commit;
  committer.warn = options.warn;
  return committer;
}

// Runs `read` over a connection of its own, on a single state of the database.
template <typename Result>
absl::StatusOr<Result> ReadOnce(const std::string& file,
                                const std::function<absl::StatusOr<Result>(MissionRows&)>& read) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto database, Database::Open(file, Database::Access::kRead));
  Transaction transaction(database.get());
  PLUMESCOUT_RETURN_IF_ERROR(transaction.BeginToRead());
  MissionRows rows(database.get());
  return read(rows);
}

absl::StatusOr<std::vector<StoredMission>> ListRows(MissionRows& rows) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<MissionRow> all, rows.List());
  std::vector<StoredMission> missions;
  for (const MissionRow& row : all) {
    absl::StatusOr<std::string> standing = rows.Standing(row);
    if (absl::IsDataLoss(standing.status())) standing = "";  // whoever acquires it is told
    PLUMESCOUT_RETURN_IF_ERROR(standing.status());
    missions.push_back({row.key, row.epoch, row.head, row.bytes, false, *std::move(standing)});
  }
  return missions;
}

// A mark may be that of a mission that was removed, and perhaps made anew, before the database was
// read; hardly twice in a row.
template <typename Read>
auto AgainIfDamaged(const Read& read) {
  auto result = read();
  if (absl::IsDataLoss(result.status())) result = read();
  return result;
}

}  // namespace

absl::StatusOr<std::unique_ptr<SqliteStore>> SqliteStore::Open(const StoreOptions& options) {
  SqliteEngineOptions engine_options;
  engine_options.folder = options.folder;
  engine_options.accept_loss = options.accept_loss;
  engine_options.warn = options.warn;
  PLUMESCOUT_ASSIGN_OR_RETURN(auto engine, SqliteEngine::Open(engine_options));
  const SqliteEngine* const known = engine.get();
  return absl::WrapUnique(new SqliteStore(options, known, std::move(engine)));
}

SqliteStore::SqliteStore(const StoreOptions& options, const SqliteEngine* engine,
                         std::unique_ptr<WriteEngine> owned)
    : CommittedStore(ToCommitterOptions(options), std::move(owned)),
      folder_(options.folder),
      engine_(engine) {}

absl::StatusOr<std::unique_ptr<JournalReader>> SqliteStore::Read(const std::string& key,
                                                                 std::int64_t first_number) {
  auto reader = AgainIfDamaged([&] {
    return SqliteReader::Open(engine_->file(), key, first_number, engine_->marks().Known(key));
  });
  PLUMESCOUT_RETURN_IF_ERROR(reader.status());
  return std::unique_ptr<JournalReader>(*std::move(reader));
}

absl::StatusOr<AcquiredMission> SqliteStore::Peek(const std::string& key) {
  return AgainIfDamaged([&] {
    const KnownHead known = engine_->marks().Known(key);
    return ReadOnce<AcquiredMission>(
        engine_->file(), [&](MissionRows& rows) -> absl::StatusOr<AcquiredMission> {
          PLUMESCOUT_ASSIGN_OR_RETURN(CheckedMission mission, LoadMission(rows, known, key));
          return std::move(mission.known);
        });
  });
}

absl::StatusOr<std::vector<StoredMission>> SqliteStore::List() {
  const std::vector<HeadMark> marks = engine_->marks().All();
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<StoredMission> rows,
                              ReadOnce<std::vector<StoredMission>>(engine_->file(), ListRows));
  std::map<std::string, StoredMission> missions;
  for (StoredMission& row : rows) {
    const std::string key = row.key;
    missions[key] = std::move(row);
  }
  for (const HeadMark& mark : marks) {
    const auto found = missions.find(mark.key);
    const bool is_known = found != missions.end() && found->second.epoch >= mark.epoch;
    // Who was removed meanwhile has no mark any more.
    if (is_known || !engine_->marks().Find(mark.key).has_value()) continue;
    missions[mark.key] = {mark.key, mark.epoch, mark.head, 0};
  }
  std::vector<StoredMission> listed;
  for (auto& [key, mission] : missions) listed.push_back(std::move(mission));
  return listed;
}

std::int64_t SqliteStore::disk_bytes() const { return StoreDiskBytes(folder_); }

absl::Status SqliteStore::Compact() {
  std::int64_t left = 1;
  bool is_last = false;
  while (!is_last) {
    is_last = left == 0;  // one more, once the log was emptied behind the one that found nothing
    StoreWrite step;
    step.kind = StoreWrite::Kind::kCompact;
    step.left = &left;
    PLUMESCOUT_RETURN_IF_ERROR(committer().SubmitAndWait(std::move(step)));
  }
  return absl::OkStatus();
}

}  // namespace plumescout::server
