// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/mission_import.h"

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/types/ids.h"
#include "core/types/status_macros.h"
#include "formats/journal/journal_file.h"
#include "proto/convert/field.h"
#include "server/base/errors.h"
#include "server/base/log.h"
#include "server/missions/mission_recovery.h"
#include "server/missions/standing_record.h"

namespace plumescout::server {
namespace {

// So many events go to the store at a time.
constexpr std::size_t kBatchRecords = 2000;
constexpr std::size_t kBatchBytes = std::size_t{4} << 20;
constexpr absl::Duration kStopLookPeriod = absl::Milliseconds(100);

// Starts what tells its end by a callback, and waits for that; but not when `stop` says so, for a
// store may try for ever.
absl::Status AwaitStore(const std::function<void(MissionStore::Done)>& start, const StopFn& stop) {
  struct End {
    absl::Status status;
    absl::Notification told;
  };
  const auto end = std::make_shared<End>();
  start([end](const absl::Status& status) {
    end->status = status;
    end->told.Notify();
  });
  while (!end->told.WaitForNotificationWithTimeout(kStopLookPeriod)) {
    if (Stops(stop)) return absl::CancelledError("the import was given up");
  }
  return end->status;
}

}  // namespace

absl::Status MissionImport::Add(const v1::MissionFilePiece& piece) {
  if (piece.offset_bytes() != sum_.bytes()) {
    return FieldError("piece.offset_bytes", static_cast<double>(piece.offset_bytes()),
                      absl::StrCat("must be ", sum_.bytes(), ", what has come"));
  }
  if (static_cast<std::int64_t>(piece.data().size()) > limits_.max_bytes - sum_.bytes()) {
    return LimitReached(absl::StrCat(
        "the file has more than limits.max_import_bytes = ", limits_.max_bytes, " bytes"));
  }
  sum_.Add(piece.data());
  if (piece.crc32() != sum_.crc32()) {
    return FieldError("piece.crc32", static_cast<double>(piece.crc32()),
                      absl::StrCat("must be ", sum_.crc32(), ", that of what has come"));
  }
  return file_.Append(piece.data());
}

absl::Status MissionImport::CheckEnd(const v1::MissionFileEnd& end) {
  if (end.total_bytes() != sum_.bytes()) {
    return FieldError("end.total_bytes", static_cast<double>(end.total_bytes()),
                      absl::StrCat("must be ", sum_.bytes(), ", what has come"));
  }
  if (end.sha256() != sum_.TakeSha256()) {
    return FieldError("end.sha256", "is not that of what has come");
  }
  return absl::OkStatus();
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionImport::Finish(const v1::MissionFileEnd& end,
                                                                   const ImportWish& wish,
                                                                   const StopFn& stop) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckEnd(end));
  PLUMESCOUT_ASSIGN_OR_RETURN(const CheckedJournal journal, CheckJournal(file_.path(), stop));
  ImportWish named = wish;
  if (named.mission.empty()) named.mission = journal.start.mission;
  PLUMESCOUT_RETURN_IF_ERROR(WithField(ValidateId("start.mission_id", named.mission), ""));
  PLUMESCOUT_RETURN_IF_ERROR(registry_.CheckChoices(journal.options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto room,
                              registry_.HoldRoom(journal.options.memory_budget_bytes));
  const std::string key = MissionKey(named.owner.tenant, named.mission);
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto name, registry_.HoldName(key));
  PLUMESCOUT_RETURN_IF_ERROR(Store(journal, key, named, stop));
  return Revive(journal, key, named, stop);
}

absl::Status MissionImport::Store(const CheckedJournal& journal, const std::string& key,
                                  const ImportWish& wish, const StopFn& stop) {
  JournalStart start = journal.start;
  start.mission = wish.mission;
  start.owner = wish.owner.name;
  start.tenant = wish.owner.tenant;
  const auto epoch = store_.Create(key, EncodeStart(start));
  if (absl::IsAlreadyExists(epoch.status())) return MissionExists(wish.mission);
  PLUMESCOUT_RETURN_IF_ERROR(epoch.status());
  const absl::Status filled = Fill(key, *epoch, stop);
  if (!filled.ok()) Remove(key, *epoch);
  return filled;
}

// Returns once it is gone: whoever hears of the failure finds nothing.
void MissionImport::Remove(const std::string& key, std::int64_t epoch) {
  AwaitStore([&](MissionStore::Done done) { store_.Remove(key, epoch, std::move(done)); }, nullptr)
      .IgnoreError();
}

absl::Status MissionImport::Fill(const std::string& key, std::int64_t epoch, const StopFn& stop) {
  PLUMESCOUT_ASSIGN_OR_RETURN(JournalFileReader reader, JournalFileReader::Open(file_.path()));
  std::int64_t head = 0;
  for (bool more = true; more;) {
    std::vector<std::string> records;
    for (std::size_t bytes = 0; records.size() < kBatchRecords && bytes < kBatchBytes;) {
      PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<Event> event, reader.Next());
      more = event.has_value();
      if (!more) break;
      records.push_back(EncodeEvent(*event, PlanDetail::kForReplay));
      bytes += records.back().size();
    }
    if (records.empty()) break;
    const auto count = static_cast<std::int64_t>(records.size());
    PLUMESCOUT_RETURN_IF_ERROR(AwaitStore(
        [&](MissionStore::Done done) {
          store_.Append(key, epoch, head + 1, std::move(records), std::move(done));
        },
        stop));
    head += count;
  }
  return AwaitStore(
      [&](MissionStore::Done done) {
        store_.PutStanding(key, epoch, EncodeStanding({}), std::move(done));
      },
      stop);
}

absl::StatusOr<std::shared_ptr<MissionHost>> MissionImport::Revive(const CheckedJournal& journal,
                                                                   const std::string& key,
                                                                   const ImportWish& wish,
                                                                   const StopFn& stop) {
  const absl::Status recovered = registry_.Recover(key, /*holds_name=*/true);
  if (!recovered.ok()) {
    const auto acquired = store_.Acquire(key);
    if (acquired.ok()) Remove(key, acquired->epoch);
    return recovered;
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(auto host, registry_.Find(wish.mission, wish.owner.tenant));
  std::uint64_t digest = 0;
  absl::Status status = AwaitStore(
      [&](const MissionStore::Done& done) {
        const absl::Status posted = host->Post(
            [&digest, done](MissionWriter& writer) {
              digest = writer.mission().Digest();
              done(absl::OkStatus());
            },
            done);
        if (!posted.ok()) done(posted);
      },
      nullptr);  // it is short, and what it writes to is here
  const std::uint64_t expected = journal.start.last_digest;
  if (status.ok() && expected != 0 && digest != expected) {
    status = absl::DataLossError(
        absl::StrCat("the events of the file make a mission with the digest ", absl::Hex(digest),
                     ", but that which was exported had ", absl::Hex(expected)));
  }
  if (status.ok() && Stops(stop)) status = absl::CancelledError("the import was given up");
  if (status.ok()) return host;
  host = nullptr;
  AwaitStore(
      [&](const MissionStore::Done& done) {
        const absl::Status begun = registry_.Delete(wish.mission, wish.owner.tenant, done);
        if (!begun.ok()) done(begun);
      },
      nullptr)
      .IgnoreError();
  return status;
}

absl::Status DropUnfinishedImports(MissionStore& store) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto missions, store.List());
  for (const StoredMission& mission : missions) {
    const auto stored = store.Peek(mission.key);
    if (!stored.ok() || !IsUnfinishedImport(*stored)) continue;
    PLUMESCOUT_ASSIGN_OR_RETURN(const AcquiredMission acquired, store.Acquire(mission.key));
    PLUMESCOUT_RETURN_IF_ERROR(AwaitStore(
        [&](MissionStore::Done done) {
          store.Remove(mission.key, acquired.epoch, std::move(done));
        },
        nullptr));
    LogInfo("unfinished import removed", {{"mission", mission.key}});
  }
  return absl::OkStatus();
}

}  // namespace plumescout::server
