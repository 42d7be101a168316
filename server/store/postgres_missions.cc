// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_missions.h"

#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kReadTimeout = absl::Seconds(30);

// Of which ReadRow reads the first fourteen columns.
constexpr absl::string_view kRow =
    "SELECT m.id, p.epoch, p.head, p.chain, p.base, p.base_chain, p.bytes, p.standing_crc, "
    "p.writes, p.crc, p.owner, n.name, m.key, octet_length(s.bytes)";
constexpr absl::string_view kFromMissions =
    " FROM plumescout_mission m LEFT JOIN plumescout_progress p ON p.mission = m.id "
    "LEFT JOIN plumescout_node n ON n.id = p.owner AND n.expires > clock_timestamp() "
    "LEFT JOIN plumescout_standing s ON s.mission = m.id ";

// Nothing if it is damaged.
std::optional<SharedRow> ReadRow(const PostgresRows& rows, int at) {
  SharedRow shared;
  MissionRow& row = shared.row;
  row.key = rows.Bytes(at, 12);
  row.id = rows.Int(at, 0);
  row.epoch = rows.Int(at, 1);
  row.head = rows.Int(at, 2);
  row.chain = static_cast<std::uint32_t>(rows.Int(at, 3));
  row.base = rows.Int(at, 4);
  row.base_chain = static_cast<std::uint32_t>(rows.Int(at, 5));
  row.bytes = rows.Int(at, 6);
  row.standing_crc = static_cast<std::uint32_t>(rows.Int(at, 7));
  row.writes = rows.Int(at, 8);
  if (rows.Int(at, 9) != RowChecksum(row)) return std::nullopt;
  shared.owner = rows.Int(at, 10);
  shared.living_node = rows.Bytes(at, 11);
  shared.standing_bytes = rows.Int(at, 13);
  return shared;
}

}  // namespace

absl::Status SharedRowDamaged(const PostgresConnection& connection, absl::string_view key,
                              absl::string_view what) {
  return StoreDamaged(absl::StrCat(connection.name(), ": ", what, " of mission ",
                                   absl::CHexEscape(key), " is not what was written"));
}

absl::StatusOr<std::map<std::string, absl::StatusOr<SharedRow>>> LoadSharedRows(
    PostgresConnection& connection, std::span<const std::string> keys) {
  PostgresStatement statement(absl::StrCat(kRow, kFromMissions, "WHERE m.key = ANY($1)"));
  statement.BindAllBytes(keys);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows, connection.Run(statement, kReadTimeout));
  std::map<std::string, absl::StatusOr<SharedRow>> loaded;
  for (int at = 0; at < rows.count(); ++at) {
    std::string key = rows.Bytes(at, 12);
    std::optional<SharedRow> row = ReadRow(rows, at);
    if (row.has_value()) {
      loaded.emplace(std::move(key), *std::move(row));
    } else {
      const absl::Status damage = SharedRowDamaged(connection, key, "the progress");
      loaded.emplace(std::move(key), damage);
    }
  }
  return loaded;
}

namespace {

// The mission's row with header and standing, its snapshots, and the checksum of its last record,
// of one state of the database.
std::vector<PostgresStatement> MissionStatements(const std::string& key) {
  std::vector<PostgresStatement> statements;
  statements.emplace_back("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY");
  statements
      .emplace_back(
          absl::StrCat(kRow, ", m.header, m.crc, s.bytes, r.crc", kFromMissions,
                       "LEFT JOIN plumescout_record r ON r.mission = m.id AND r.number = p.head "
                       "WHERE m.key = $1"))
      .BindBytes(key);
  statements
      .emplace_back(
          "SELECT s.revision, s.digest, s.crc, s.bytes FROM plumescout_snapshot s "
          "JOIN plumescout_mission m ON m.id = s.mission WHERE m.key = $1 ORDER BY s.revision DESC")
      .BindBytes(key);
  statements.emplace_back("COMMIT");
  return statements;
}

// A damaged snapshot is left out: what it held, the records tell too.
std::vector<StoredSnapshot> ReadSnapshots(const PostgresRows& rows, const MissionRow& row) {
  std::vector<StoredSnapshot> snapshots;
  for (int at = 0; at < rows.count(); ++at) {
    StoredSnapshot snapshot;
    snapshot.revision = rows.Int(at, 0);
    snapshot.digest = static_cast<std::uint64_t>(rows.Int(at, 1));
    snapshot.bytes = rows.Bytes(at, 3);
    const bool is_whole =
        rows.Int(at, 2) == SnapshotChecksum(row.id, snapshot) && snapshot.revision <= row.head;
    if (is_whole) snapshots.push_back(std::move(snapshot));
  }
  return snapshots;
}

}  // namespace

absl::StatusOr<SharedMission> LoadSharedMission(PostgresConnection& connection,
                                                const std::string& key) {
  const std::vector<PostgresStatement> statements = MissionStatements(key);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<PostgresRows> answers,
                              connection.RunAll(statements, 2 * kReadTimeout));
  const PostgresRows& rows = answers[1];
  if (rows.count() == 0) return NotStored(key);
  const std::optional<SharedRow> shared = ReadRow(rows, 0);
  if (!shared.has_value()) return SharedRowDamaged(connection, key, "the progress");
  const MissionRow& row = shared->row;
  SharedMission mission;
  mission.shared = *shared;
  mission.known.epoch = row.epoch;
  mission.known.head = row.head;
  mission.known.first = row.base + 1;
  mission.known.header = rows.Bytes(0, 14);
  const std::int64_t header_crc = rows.Int(0, 15);
  if (header_crc != HeaderChecksum(key, mission.known.header)) {
    return SharedRowDamaged(connection, key, "the header");
  }
  mission.known.standing = rows.Bytes(0, 16);
  if (row.standing_crc != Checksum().Add(mission.known.standing).value()) {
    return SharedRowDamaged(connection, key, "the standing");
  }
  // Records up to the base may be gone.
  const std::int64_t last_crc = row.head == 0          ? header_crc
                                : row.head == row.base ? row.base_chain
                                : rows.is_null(0, 17)  ? -1
                                                       : rows.Int(0, 17);
  if (last_crc != row.chain) {
    return SharedRowDamaged(connection, key, absl::StrCat("record ", row.head));
  }
  mission.known.snapshots = ReadSnapshots(answers[2], row);
  return mission;
}

absl::StatusOr<DamagedRow> LoadDamagedRow(PostgresConnection& connection, const std::string& key,
                                          std::int64_t lease) {
  const absl::Status status = LoadSharedMission(connection, key).status();
  if (status.ok()) return NotDamaged(key);
  if (!absl::IsDataLoss(status)) return status;
  PostgresStatement statement(absl::StrCat(kRow, kFromMissions, "WHERE m.key = $1"));
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows,
                              connection.Run(statement.BindBytes(key), kReadTimeout));
  if (rows.count() == 0) return NotStored(key);
  DamagedRow row;
  row.id = rows.Int(0, 0);
  row.has_progress = !rows.is_null(0, 1);
  row.epoch = rows.Int(0, 1);
  row.head = rows.Int(0, 2);
  row.writes = rows.Int(0, 8);
  row.crc = rows.Int(0, 9);
  const std::string living_node = rows.Bytes(0, 11);
  if (!living_node.empty() && rows.Int(0, 10) != lease) return MissionElsewhere(key, living_node);
  return row;
}

absl::StatusOr<std::vector<StoredMission>> ListSharedMissions(PostgresConnection& connection) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const PostgresRows rows,
      connection.Run(PostgresStatement(absl::StrCat(
                         kRow, ", d.mission IS NOT NULL, s.bytes", kFromMissions,
                         "LEFT JOIN plumescout_damage d ON d.mission = m.id ORDER BY m.key")),
                     kReadTimeout));
  std::vector<StoredMission> missions;
  for (int at = 0; at < rows.count(); ++at) {
    SharedRow damaged;
    damaged.row.key = rows.Bytes(at, 12);
    const std::optional<SharedRow> whole = ReadRow(rows, at);
    const MissionRow& row = whole.value_or(damaged).row;
    const bool is_damaged = !whole.has_value() || rows.Int(at, 14) != 0;
    std::string standing = rows.Bytes(at, 15);
    if (row.standing_crc != Checksum().Add(standing).value()) standing = "";
    missions.push_back({row.key, row.epoch, row.head, row.bytes, is_damaged, std::move(standing)});
  }
  return missions;
}

absl::StatusOr<std::vector<std::uint32_t>> SharedChainsAt(PostgresConnection& connection,
                                                          const MissionRow& row,
                                                          std::span<const std::int64_t> numbers) {
  PostgresStatement statement(
      "SELECT number, crc FROM plumescout_record WHERE mission = $1 AND number = ANY($2) "
      "UNION ALL SELECT 0, crc FROM plumescout_mission WHERE id = $1 AND 0 = ANY($2)");
  statement.Bind(row.id).BindNumbers(numbers);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows, connection.Run(statement, kReadTimeout));
  std::map<std::int64_t, std::uint32_t> found;
  for (int at = 0; at < rows.count(); ++at) {
    found[rows.Int(at, 0)] = static_cast<std::uint32_t>(rows.Int(at, 1));
  }
  if (row.base > 0) found[row.base] = row.base_chain;
  std::vector<std::uint32_t> chains;
  for (const std::int64_t number : numbers) {
    const auto chain = found.find(number);
    if (chain == found.end()) {
      return SharedRowDamaged(connection, row.key, absl::StrCat("record ", number));
    }
    chains.push_back(chain->second);
  }
  return chains;
}

absl::StatusOr<bool> SharedHoldsRecords(PostgresConnection& connection, const MissionRow& row,
                                        std::int64_t first_number,
                                        std::span<const std::string> records) {
  const std::int64_t last = first_number + static_cast<std::int64_t>(records.size()) - 1;
  if (first_number <= row.base || last > row.head) return false;
  const std::int64_t numbers[] = {first_number - 1, last};
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<std::uint32_t> chains,
                              SharedChainsAt(connection, row, numbers));
  std::uint32_t chain = chains[0];
  std::int64_t number = first_number;
  for (const std::string& record : records) chain = ChainChecksum(chain, number++, record);
  return chain == chains[1];
}

absl::StatusOr<std::vector<std::pair<std::int64_t, std::int64_t>>> SharedSnapshotSizes(
    PostgresConnection& connection, const MissionRow& row) {
  PostgresStatement statement(
      "SELECT revision, octet_length(bytes) FROM plumescout_snapshot WHERE mission = $1 "
      "ORDER BY revision DESC");
  statement.Bind(row.id);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows, connection.Run(statement, kReadTimeout));
  std::vector<std::pair<std::int64_t, std::int64_t>> sizes;
  for (int at = 0; at < rows.count(); ++at) sizes.emplace_back(rows.Int(at, 0), rows.Int(at, 1));
  return sizes;
}

absl::StatusOr<std::int64_t> SharedRecordBytes(PostgresConnection& connection,
                                               const MissionRow& row, std::int64_t after,
                                               std::int64_t last) {
  PostgresStatement statement(
      "SELECT coalesce(sum(octet_length(bytes)), 0)::bigint FROM plumescout_record "
      "WHERE mission = $1 AND number > $2 AND number <= $3");
  statement.Bind(row.id).Bind(after).Bind(last);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows, connection.Run(statement, kReadTimeout));
  return rows.Int(0, 0);
}

absl::StatusOr<std::int64_t> NextSharedId(PostgresConnection& connection) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const PostgresRows rows,
      connection.Run(PostgresStatement("SELECT nextval('plumescout_ids')"), kReadTimeout));
  return rows.Int(0, 0);
}

}  // namespace plumescout::server
