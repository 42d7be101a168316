// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/mission_rows.h"

#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/checksum.h"
#include "server/store/store_errors.h"
#include "server/store/store_write.h"

namespace plumescout::server {
namespace {

std::int64_t SizeOf(const std::string& bytes) { return static_cast<std::int64_t>(bytes.size()); }

// Of the columns id, epoch, head, chain, base, base_chain, bytes, standing_crc, writes, crc.
// Nothing if it is damaged.
std::optional<MissionRow> RowOf(const Query& query, const std::string& key) {
  MissionRow row;
  row.key = key;
  row.id = query.Int(0);
  row.epoch = query.Int(1);
  row.head = query.Int(2);
  row.chain = static_cast<std::uint32_t>(query.Int(3));
  row.base = query.Int(4);
  row.base_chain = static_cast<std::uint32_t>(query.Int(5));
  row.bytes = query.Int(6);
  row.standing_crc = static_cast<std::uint32_t>(query.Int(7));
  row.writes = query.Int(8);
  if (query.Int(9) != RowChecksum(row)) return std::nullopt;
  return row;
}

// Of the columns revision, digest, crc, bytes. Nothing if it is damaged.
std::optional<StoredSnapshot> SnapshotOf(const Query& query, const MissionRow& row) {
  StoredSnapshot snapshot;
  snapshot.revision = query.Int(0);
  snapshot.digest = static_cast<std::uint64_t>(query.Int(1));
  snapshot.bytes = query.Bytes(3);
  const bool is_whole =
      query.Int(2) == SnapshotChecksum(row.id, snapshot) && snapshot.revision <= row.head;
  if (!is_whole) return std::nullopt;
  return snapshot;
}

constexpr char kSelectSnapshots[] =
    "SELECT revision, digest, crc, bytes FROM snapshot WHERE mission = ? ORDER BY revision DESC";

}  // namespace

absl::Status MissionRows::Damaged(const MissionRow& row, absl::string_view what) const {
  return StoreDamaged(absl::StrCat(database_->path(), ": ", what, " of mission ",
                                   absl::CHexEscape(row.key), " is not what was written"));
}

absl::StatusOr<std::optional<MissionRow>> MissionRows::Find(const std::string& key) {
  Query query = database_->Use(
      "SELECT m.id, p.epoch, p.head, p.chain, p.base, p.base_chain, p.bytes, p.standing_crc, "
      "p.writes, p.crc "
      "FROM mission m LEFT JOIN progress p ON p.mission = m.id WHERE m.key = ?");
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.BindText(key).Next());
  if (!is_there) return std::optional<MissionRow>();
  std::optional<MissionRow> row = RowOf(query, key);
  if (!row.has_value()) {
    MissionRow damaged;
    damaged.key = key;
    return Damaged(damaged, "the progress");
  }
  return row;
}

absl::StatusOr<std::optional<std::int64_t>> MissionRows::FindId(const std::string& key) {
  Query query = database_->Use("SELECT id FROM mission WHERE key = ?");
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.BindText(key).Next());
  return is_there ? std::optional<std::int64_t>(query.Int(0)) : std::nullopt;
}

absl::StatusOr<std::vector<MissionRow>> MissionRows::List() {
  Query query = database_->Use(
      "SELECT m.id, p.epoch, p.head, p.chain, p.base, p.base_chain, p.bytes, p.standing_crc, "
      "p.writes, p.crc, m.key "
      "FROM mission m LEFT JOIN progress p ON p.mission = m.id ORDER BY m.key");
  std::vector<MissionRow> rows;
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool has_row, query.Next());
    if (!has_row) return rows;
    MissionRow damaged;
    damaged.key = query.Bytes(10);
    rows.push_back(RowOf(query, damaged.key).value_or(damaged));
  }
}

absl::StatusOr<std::string> MissionRows::Header(const MissionRow& row) {
  Query query = database_->Use("SELECT header, crc FROM mission WHERE id = ?");
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.Bind(row.id).Next());
  std::string header = is_there ? query.Bytes(0) : "";
  if (!is_there || query.Int(1) != HeaderChecksum(row.key, header)) {
    return Damaged(row, "the header");
  }
  return header;
}

absl::StatusOr<std::string> MissionRows::Standing(const MissionRow& row) {
  Query query = database_->Use("SELECT bytes FROM standing WHERE mission = ?");
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.Bind(row.id).Next());
  std::string standing = is_there ? query.Bytes(0) : "";
  if (row.standing_crc != Checksum().Add(standing).value()) return Damaged(row, "the standing");
  return standing;
}

absl::StatusOr<std::uint32_t> MissionRows::ChainAt(const MissionRow& row, std::int64_t number) {
  if (number == row.base && row.base > 0) return row.base_chain;
  if (number == 0) {
    Query query = database_->Use("SELECT crc FROM mission WHERE id = ?");
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.Bind(row.id).Next());
    if (!is_there) return Damaged(row, "the header");
    return static_cast<std::uint32_t>(query.Int(0));
  }
  Query query = database_->Use("SELECT crc FROM record WHERE mission = ? AND number = ?");
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.Bind(row.id).Bind(number).Next());
  if (!is_there) return Damaged(row, absl::StrCat("record ", number));
  return static_cast<std::uint32_t>(query.Int(0));
}

absl::StatusOr<std::vector<StoredSnapshot>> MissionRows::Snapshots(const MissionRow& row) {
  Query query = database_->Use(kSelectSnapshots);
  query.Bind(row.id);
  std::vector<StoredSnapshot> snapshots;
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool has_row, query.Next());
    if (!has_row) return snapshots;
    std::optional<StoredSnapshot> snapshot = SnapshotOf(query, row);
    if (snapshot.has_value()) snapshots.push_back(*std::move(snapshot));
  }
}

absl::StatusOr<int> MissionRows::CountDamagedSnapshots(const MissionRow& row) {
  Query query = database_->Use(kSelectSnapshots);
  query.Bind(row.id);
  int damaged = 0;
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool has_row, query.Next());
    if (!has_row) return damaged;
    damaged += SnapshotOf(query, row).has_value() ? 0 : 1;
  }
}

absl::StatusOr<MissionRow> MissionRows::Insert(const std::string& key, const std::string& header) {
  MissionRow row;
  row.key = key;
  row.chain = HeaderChecksum(key, header);
  PLUMESCOUT_RETURN_IF_ERROR(database_->Use("INSERT INTO mission(key, header, crc) VALUES(?, ?, ?)")
                                 .BindText(key)
                                 .BindBlob(header)
                                 .Bind(row.chain)
                                 .Run());
  row.id = database_->last_insert_id();
  row.epoch = 1;
  row.bytes = SizeOf(header);
  row.standing_crc = Checksum().Add(absl::string_view()).value();
  PLUMESCOUT_RETURN_IF_ERROR(Save(row));
  return row;
}

absl::Status MissionRows::Save(MissionRow& row) {
  ++row.writes;
  return database_
      ->Use(
          "REPLACE INTO progress(mission, epoch, head, chain, base, base_chain, bytes, "
          "standing_crc, writes, crc) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .Bind(row.id)
      .Bind(row.epoch)
      .Bind(row.head)
      .Bind(row.chain)
      .Bind(row.base)
      .Bind(row.base_chain)
      .Bind(row.bytes)
      .Bind(row.standing_crc)
      .Bind(row.writes)
      .Bind(RowChecksum(row))
      .Run();
}

absl::Status MissionRows::AddRecords(MissionRow& row, std::span<const std::string> records) {
  for (const std::string& record : records) {
    const std::int64_t number = row.head + 1;
    const std::uint32_t chain = ChainChecksum(row.chain, number, record);
    PLUMESCOUT_RETURN_IF_ERROR(
        database_->Use("INSERT INTO record(mission, number, crc, bytes) VALUES(?, ?, ?, ?)")
            .Bind(row.id)
            .Bind(number)
            .Bind(chain)
            .BindBlob(record)
            .Run());
    row.head = number;
    row.chain = chain;
    row.bytes += SizeOf(record);
  }
  return absl::OkStatus();
}

absl::Status MissionRows::PutStanding(MissionRow& row, const std::string& standing) {
  std::int64_t older_bytes = 0;
  {
    Query query = database_->Use("SELECT length(bytes) FROM standing WHERE mission = ?");
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.Bind(row.id).Next());
    if (is_there) older_bytes = query.Int(0);
  }
  PLUMESCOUT_RETURN_IF_ERROR(database_->Use("REPLACE INTO standing(mission, bytes) VALUES(?, ?)")
                                 .Bind(row.id)
                                 .BindBlob(standing)
                                 .Run());
  row.bytes += SizeOf(standing) - older_bytes;
  row.standing_crc = Checksum().Add(standing).value();
  return absl::OkStatus();
}

absl::Status MissionRows::PutSnapshot(MissionRow& row, const StoredSnapshot& snapshot) {
  std::vector<std::pair<std::int64_t, std::int64_t>> leaving;  // rows and their bytes
  {
    Query query = database_->Use(
        "SELECT id, revision, length(bytes) FROM snapshot WHERE mission = ? "
        "ORDER BY revision DESC");
    query.Bind(row.id);
    int newer = 0;
    int others = 0;
    while (true) {
      PLUMESCOUT_ASSIGN_OR_RETURN(const bool has_row, query.Next());
      if (!has_row) break;
      const bool is_same = query.Int(1) == snapshot.revision;
      newer += query.Int(1) > snapshot.revision ? 1 : 0;
      others += is_same ? 0 : 1;
      if (is_same || others >= kKeptSnapshots) leaving.emplace_back(query.Int(0), query.Int(2));
    }
    if (newer >= kKeptSnapshots) return absl::OkStatus();
  }
  for (const auto& [id, bytes] : leaving) {
    PLUMESCOUT_RETURN_IF_ERROR(database_->Use("DELETE FROM snapshot WHERE id = ?").Bind(id).Run());
    row.bytes -= bytes;
  }
  row.bytes += SizeOf(snapshot.bytes);
  return database_
      ->Use("INSERT INTO snapshot(mission, revision, digest, crc, bytes) VALUES(?, ?, ?, ?, ?)")
      .Bind(row.id)
      .Bind(snapshot.revision)
      .Bind(static_cast<std::int64_t>(snapshot.digest))
      .Bind(SnapshotChecksum(row.id, snapshot))
      .BindBlob(snapshot.bytes)
      .Run();
}

absl::Status MissionRows::Trim(MissionRow& row) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<StoredSnapshot> snapshots, Snapshots(row));
  if (snapshots.size() < kKeptSnapshots) return absl::OkStatus();
  const std::int64_t last = snapshots.back().revision;
  if (last <= row.base) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::uint32_t chain, ChainAt(row, last));
  {
    Query query = database_->Use(
        "SELECT sum(length(bytes)) FROM record "
        "WHERE mission = ? AND number > ? AND number <= ?");
    query.Bind(row.id).Bind(row.base).Bind(last);
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.Next());
    if (is_there) row.bytes -= query.Int(0);
  }
  row.base = last;
  row.base_chain = chain;
  return absl::OkStatus();
}

absl::Status MissionRows::Delete(const MissionRow& row) {
  for (const char* sql :
       {"DELETE FROM mission WHERE id = ?", "DELETE FROM progress WHERE mission = ?",
        "DELETE FROM standing WHERE mission = ?", "DELETE FROM snapshot WHERE mission = ?",
        "INSERT INTO removed(mission) VALUES(?)"}) {
    PLUMESCOUT_RETURN_IF_ERROR(database_->Use(sql).Bind(row.id).Run());
  }
  return absl::OkStatus();
}

absl::StatusOr<bool> MissionRows::PurgeRemoved(int max_records) {
  std::int64_t mission = 0;
  {
    Query query = database_->Use("SELECT mission FROM removed LIMIT 1");
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.Next());
    if (!is_there) return false;
    mission = query.Int(0);
  }
  {
    Query query = database_->Use("SELECT key FROM mission WHERE id = ?");
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, query.Bind(mission).Next());
    if (is_there) return StoreDamaged(absl::StrCat(file(), ": a mission is listed as removed"));
  }
  PLUMESCOUT_RETURN_IF_ERROR(
      database_
          ->Use("DELETE FROM record WHERE id IN "
                "(SELECT id FROM record WHERE mission = ? ORDER BY number LIMIT ?)")
          .Bind(mission)
          .Bind(max_records)
          .Run());
  if (database_->changes() == 0) {
    PLUMESCOUT_RETURN_IF_ERROR(
        database_->Use("DELETE FROM removed WHERE mission = ?").Bind(mission).Run());
  }
  return true;
}

absl::StatusOr<bool> MissionRows::PurgeTrimmed(int max_records) {
  PLUMESCOUT_RETURN_IF_ERROR(
      database_
          ->Use("DELETE FROM record WHERE id IN (SELECT r.id FROM progress p "
                "CROSS JOIN record r ON r.mission = p.mission AND r.number <= p.base LIMIT ?)")
          .Bind(max_records)
          .Run());
  return database_->changes() > 0;
}

absl::StatusOr<bool> MissionRows::HoldsRecords(const MissionRow& row, std::int64_t first_number,
                                               std::span<const std::string> records) {
  const std::int64_t last = first_number + static_cast<std::int64_t>(records.size()) - 1;
  if (first_number <= row.base || last > row.head) return false;
  PLUMESCOUT_ASSIGN_OR_RETURN(std::uint32_t chain, ChainAt(row, first_number - 1));
  std::int64_t number = first_number;
  for (const std::string& record : records) chain = ChainChecksum(chain, number++, record);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::uint32_t found, ChainAt(row, last));
  return found == chain;
}

}  // namespace plumescout::server
