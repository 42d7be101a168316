// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_engine.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/head_marks.h"
#include "server/store/postgres_changes.h"
#include "server/store/postgres_schema.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

using Kind = StoreWrite::Kind;

constexpr absl::Duration kOpenTimeout = absl::Seconds(5);
constexpr absl::Duration kCommitTimeout = absl::Seconds(30);
constexpr int kMaxRounds = 8;
constexpr std::int64_t kPurgedRecords = 500;  // in one chore

std::int64_t SizeOfAll(std::span<const std::string> parts) {
  std::size_t sum = 0;
  for (const std::string& part : parts) sum += part.size();
  return static_cast<std::int64_t>(sum);
}

// The row after one more write.
SharedRow Next(SharedRow shared) {
  ++shared.row.writes;
  return shared;
}

}  // namespace

absl::Status PostgresEngine::Connect() {
  known_.clear();
  PLUMESCOUT_ASSIGN_OR_RETURN(auto opened, PostgresConnection::Open(options_.url, kOpenTimeout));
  PLUMESCOUT_RETURN_IF_ERROR(CheckSameStore(*opened, options_.store));
  connection_ = std::move(opened);
  return absl::OkStatus();
}

absl::Status PostgresEngine::Commit(std::span<StoreWrite> writes) {
  if (connection_ == nullptr) PLUMESCOUT_RETURN_IF_ERROR(Connect());
  const absl::Status status = writes.empty() ? DoChore() : CommitConnected(writes);
  if (status.ok()) return status;
  connection_ = nullptr;
  if (writes.empty() && !absl::IsUnavailable(status)) has_chores_ = false;  // it would fail again
  return status;
}

absl::Status PostgresEngine::CommitConnected(std::span<StoreWrite> writes) {
  std::vector<StoreWrite*> left;
  for (StoreWrite& write : writes) {
    write.result = absl::OkStatus();
    write.inserted = false;
    left.push_back(&write);
  }
  std::stable_sort(left.begin(), left.end(),
                   [](const StoreWrite* a, const StoreWrite* b) { return a->key < b->key; });
  for (int round = 0; !left.empty(); ++round) {
    if (round == kMaxRounds) {
      return StoreUnavailable(
          absl::StrCat(connection_->name(), ": mission ", absl::CHexEscape(left.front()->key),
                       " is changed by others all the time, or this node's lease has run out"));
    }
    PLUMESCOUT_RETURN_IF_ERROR(CommitRound(left, round == 0));
  }
  return absl::OkStatus();
}

absl::Status PostgresEngine::CommitRound(std::vector<StoreWrite*>& writes, bool is_first) {
  PLUMESCOUT_RETURN_IF_ERROR(LoadRows(writes, is_first));
  Round round;
  for (StoreWrite* const write : writes) {
    if (round.put_off_keys.contains(write->key)) {
      round.put_off.push_back(write);
    } else {
      PLUMESCOUT_RETURN_IF_ERROR(Plan(round, *write));
    }
  }
  PLUMESCOUT_RETURN_IF_ERROR(Send(round));
  for (auto& [key, row] : round.rows) {
    known_.erase(key);
    if (round.put_off_keys.contains(key)) continue;
    if (!row.has_value()) own_.erase(key);
    if (row.has_value()) known_.emplace(key, *std::move(row));
  }
  for (const std::string& key : round.put_off_keys) known_.erase(key);
  // In their order: of one mission, those that were sent came before those that waited.
  std::vector<StoreWrite*> left;
  for (StoreWrite* const write : writes) {
    const auto& again = round.put_off;
    if (std::find(again.begin(), again.end(), write) != again.end()) left.push_back(write);
  }
  writes = std::move(left);
  return absl::OkStatus();
}

absl::Status PostgresEngine::Send(Round& round) {
  if (round.statements.empty()) return absl::OkStatus();
  std::vector<PostgresStatement> statements;
  if (!round.forgotten.empty()) {
    // Who died in the middle of a commit may hold a row for long; all missions wait behind this.
    statements.emplace_back("SELECT set_config('lock_timeout', '1s', true)");
    for (const std::int64_t lease : round.forgotten) statements.push_back(ForgetStatement(lease));
  }
  const std::size_t first = statements.size();
  std::move(round.statements.begin(), round.statements.end(), std::back_inserter(statements));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<PostgresRows> answers,
                              connection_->RunAll(statements, kCommitTimeout));
  for (const Planned& planned : round.planned) {
    if (answers[first + planned.statement].Int(0, 0) > 0) continue;
    planned.write->inserted = false;
    round.put_off_keys.insert(planned.write->key);
    round.put_off.push_back(planned.write);
  }
  return absl::OkStatus();
}

absl::Status PostgresEngine::LoadRows(const std::vector<StoreWrite*>& writes, bool is_first) {
  std::set<std::string> keys;
  for (const StoreWrite* const write : writes) {
    const bool is_known = is_first && known_.contains(write->key) && !write->tried;
    if (!is_known) keys.insert(write->key);
  }
  fresh_.clear();
  if (keys.empty()) return absl::OkStatus();
  for (const std::string& key : keys) known_.erase(key);
  const std::vector<std::string> list(keys.begin(), keys.end());
  PLUMESCOUT_ASSIGN_OR_RETURN(fresh_, LoadSharedRows(*connection_, list));
  for (const std::string& key : list) fresh_.emplace(key, NotStored(key));
  return absl::OkStatus();
}

absl::Status PostgresEngine::Plan(Round& round, StoreWrite& write) {
  if (write.kind == Kind::kCompact) return absl::OkStatus();  // the database sees to it by itself
  const auto planned = round.rows.find(write.key);
  if (write.kind == Kind::kDiscard) return PlanDiscard(round, write);
  const auto known = known_.find(write.key);
  const auto fresh = fresh_.find(write.key);
  std::optional<SharedRow> shared;
  absl::Status missing = NotStored(write.key);
  if (planned != round.rows.end()) {
    shared = planned->second;
  } else if (known != known_.end()) {
    shared = known->second;
  } else if (fresh->second.ok()) {
    shared = *fresh->second;
  } else {
    missing = fresh->second.status();
  }
  if (write.kind == Kind::kCreate) {
    return PlanCreate(round, write, shared.has_value() ? &*shared : nullptr);
  }
  if (!shared.has_value()) {
    const bool is_done =
        write.kind == Kind::kUndoCreate || (write.kind == Kind::kRemove && write.tried);
    if (!is_done || absl::IsDataLoss(missing)) Refuse(round, write, missing);
    return absl::OkStatus();
  }
  if (write.kind == Kind::kUndoCreate) return PlanUndo(round, write, *shared);
  if (write.kind == Kind::kAcquire) return PlanAcquire(round, write);
  if (shared->row.epoch != write.epoch) {
    Refuse(round, write, FencedByEpoch(write.key, write.epoch, shared->row.epoch));
    return absl::OkStatus();
  }
  if (!IsOwn(shared->row)) {
    Refuse(round, write, FencedByNamesake(write.key));
    return absl::OkStatus();
  }
  return PlanFor(round, write, *shared);
}

absl::Status PostgresEngine::NoLease() const {
  return StoreUnavailable(absl::StrCat(connection_->name(), ": this node has no lease"));
}

bool PostgresEngine::IsOwn(const MissionRow& row) const {
  const auto own = own_.find(row.key);
  return own != own_.end() && own->second.epoch == row.epoch && own->second.id == row.id;
}

absl::Status PostgresEngine::PlanFor(Round& round, StoreWrite& write, const SharedRow& shared) {
  if (write.kind == Kind::kAppend) return PlanAppend(round, write, shared);
  if (write.kind == Kind::kSnapshot) return PlanSnapshot(round, write, shared);
  if (write.kind == Kind::kTrim) return PlanTrim(round, write, shared);
  if (write.kind == Kind::kRemove) {
    Add(round, write, RemoveStatement(shared.row), std::nullopt);
    has_chores_ = true;
    return absl::OkStatus();
  }
  SharedRow after = Next(shared);
  after.standing_bytes = static_cast<std::int64_t>(write.bytes.size());
  after.row.bytes += after.standing_bytes - shared.standing_bytes;
  after.row.standing_crc = Checksum().Add(write.bytes).value();
  Add(round, write, StandingStatement(shared.row, after.row, write.bytes), after);
  return absl::OkStatus();
}

absl::Status PostgresEngine::PlanCreate(Round& round, StoreWrite& write, const SharedRow* shared) {
  if (write.key.empty() || write.key.size() > kMaxMissionKeyBytes) {
    write.result = absl::InvalidArgumentError(
        absl::StrCat("a key of ", write.key.size(), " bytes, not 1 to ", kMaxMissionKeyBytes));
    return absl::OkStatus();
  }
  const std::int64_t lease = options_.lease();
  if (shared != nullptr) {
    Refuse(round, write, AlreadyStored(write.key));
    return absl::OkStatus();
  }
  if (lease == 0) {
    write.result = NoLease();
    return absl::OkStatus();
  }
  SharedRow made;
  made.row.key = write.key;
  PLUMESCOUT_ASSIGN_OR_RETURN(made.row.id, NextSharedId(*connection_));
  made.row.epoch = 1;
  made.row.chain = HeaderChecksum(write.key, write.bytes);
  made.row.bytes = static_cast<std::int64_t>(write.bytes.size());
  made.row.standing_crc = Checksum().Add(absl::string_view()).value();
  made.row.writes = 1;
  made.owner = lease;
  own_[write.key] = {made.row.epoch, made.row.id};
  write.inserted = true;
  Add(round, write, CreateStatement(made.row, write.bytes, lease), made);
  return absl::OkStatus();
}

absl::Status PostgresEngine::PlanUndo(Round& round, StoreWrite& write, const SharedRow& shared) {
  if (!IsOwn(shared.row) || shared.row.epoch > 1 || shared.row.head > 0) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(const SharedMission mission,
                              LoadSharedMission(*connection_, write.key));
  if (mission.known.header != write.bytes) return absl::OkStatus();
  Add(round, write, RemoveStatement(shared.row), std::nullopt);
  has_chores_ = true;
  return absl::OkStatus();
}

absl::Status PostgresEngine::PlanAcquire(Round& round, StoreWrite& write) {
  absl::StatusOr<SharedMission> mission = LoadSharedMission(*connection_, write.key);
  if (absl::IsNotFound(mission.status()) || absl::IsDataLoss(mission.status())) {
    write.result = mission.status();
    return absl::OkStatus();
  }
  PLUMESCOUT_RETURN_IF_ERROR(mission.status());
  const std::int64_t lease = options_.lease();
  if (lease == 0) {
    write.result = NoLease();
    return absl::OkStatus();
  }
  const SharedRow& before = mission->shared;
  if (!before.living_node.empty() && before.owner != lease) {
    write.result = MissionElsewhere(write.key, before.living_node);
    return absl::OkStatus();
  }
  SharedRow after = Next(before);
  ++after.row.epoch;
  after.owner = lease;
  own_[write.key] = {after.row.epoch, after.row.id};
  round.forgotten.insert(before.owner);
  Add(round, write, AcquireStatement(before.row, after.row, lease), after);
  mission->known.epoch = after.row.epoch;
  if (write.acquired != nullptr) *write.acquired = std::move(mission->known);
  return absl::OkStatus();
}

absl::Status PostgresEngine::PlanDiscard(Round& round, StoreWrite& write) {
  const std::int64_t lease = options_.lease();
  const auto row = LoadDamagedRow(*connection_, write.key, lease);
  if (round.rows.contains(write.key)) {
    PutOff(round, write);
  } else if (row.ok()) {
    Add(round, write, DiscardStatement(*row, lease), std::nullopt);
    has_chores_ = true;
  } else if (absl::IsUnavailable(row.status()) && NodeElsewhere(row.status()).empty()) {
    return row.status();
  } else if (!absl::IsNotFound(row.status()) || !write.tried) {
    write.result = row.status();
  }
  return absl::OkStatus();
}

absl::Status PostgresEngine::PlanAppend(Round& round, StoreWrite& write, const SharedRow& shared) {
  const MissionRow& row = shared.row;
  if (write.first_number == row.head + 1) {
    SharedRow after = Next(shared);
    for (const std::string& record : write.records) {
      after.row.chain = ChainChecksum(after.row.chain, ++after.row.head, record);
    }
    after.row.bytes += SizeOfAll(write.records);
    Add(round, write, AppendStatement(row, after.row, write.records), after);
    return absl::OkStatus();
  }
  const auto is_done =
      write.tried ? SharedHoldsRecords(*connection_, row, write.first_number, write.records)
                  : absl::StatusOr<bool>(false);
  PLUMESCOUT_RETURN_IF_ERROR(is_done.status());
  if (*is_done) {
    // A standby that a commit waits for may not have them yet: one more commit waits for it.
    const SharedRow after = Next(shared);
    Add(round, write, SaveStatement(row, after.row), after);
  } else {
    Refuse(round, write, FencedByHead(write.key, write.first_number, row.head));
  }
  return absl::OkStatus();
}

absl::Status PostgresEngine::PlanSnapshot(Round& round, StoreWrite& write,
                                          const SharedRow& shared) {
  const StoredSnapshot& snapshot = write.snapshot;
  if (snapshot.revision > shared.row.head) {
    Refuse(round, write, SnapshotAhead(write.key, snapshot.revision, shared.row.head));
    return absl::OkStatus();
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto sizes, SharedSnapshotSizes(*connection_, shared.row));
  SharedRow after = Next(shared);
  std::vector<std::int64_t> leaving;
  int newer = 0;
  int others = 0;
  for (const auto& [revision, bytes] : sizes) {
    const bool is_same = revision == snapshot.revision;
    newer += revision > snapshot.revision ? 1 : 0;
    others += is_same ? 0 : 1;
    if (!is_same && others < kKeptSnapshots) continue;
    after.row.bytes -= bytes;
    if (!is_same) leaving.push_back(revision);
  }
  if (newer >= kKeptSnapshots) return absl::OkStatus();
  after.row.bytes += static_cast<std::int64_t>(snapshot.bytes.size());
  Add(round, write, SnapshotStatement(shared.row, after.row, snapshot, leaving), after);
  return absl::OkStatus();
}

absl::Status PostgresEngine::PlanTrim(Round& round, StoreWrite& write, const SharedRow& shared) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const SharedMission mission,
                              LoadSharedMission(*connection_, write.key));
  const std::vector<StoredSnapshot>& snapshots = mission.known.snapshots;
  if (snapshots.size() < kKeptSnapshots) return absl::OkStatus();
  const std::int64_t last = snapshots.back().revision;
  if (last <= shared.row.base) return absl::OkStatus();
  const std::int64_t numbers[] = {last};
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> chains,
                              SharedChainsAt(*connection_, shared.row, numbers));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t bytes,
                              SharedRecordBytes(*connection_, shared.row, shared.row.base, last));
  SharedRow after = Next(shared);
  after.row.base = last;
  after.row.base_chain = chains[0];
  after.row.bytes -= bytes;
  Add(round, write, SaveStatement(shared.row, after.row), after);
  has_chores_ = true;
  return absl::OkStatus();
}

void PostgresEngine::Add(Round& round, StoreWrite& write, PostgresStatement statement,
                         std::optional<SharedRow> after) {
  round.planned.push_back({&write, round.statements.size()});
  round.statements.push_back(std::move(statement));
  round.rows[write.key] = std::move(after);
}

void PostgresEngine::Refuse(Round& round, StoreWrite& write, absl::Status why) {
  if (fresh_.contains(write.key)) {
    write.result = std::move(why);
    return;
  }
  PutOff(round, write);
}

void PostgresEngine::PutOff(Round& round, StoreWrite& write) {
  round.put_off.push_back(&write);
  round.put_off_keys.insert(write.key);
}

absl::Status PostgresEngine::DoChore() {
  if (!has_chores_) {
    return connection_
        ->Run(PostgresStatement("UPDATE plumescout_probe SET count = count + 1"), kCommitTimeout)
        .status();
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<PostgresRows> answers,
                              connection_->RunAll(PurgeStatements(kPurgedRecords), kCommitTimeout));
  has_chores_ = answers[0].Int(0, 0) + answers[1].Int(0, 0) > 0;
  return absl::OkStatus();
}

}  // namespace plumescout::server
