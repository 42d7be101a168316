// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_schema.h"

#include <vector>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "core/types/status_macros.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kTimeout = absl::Seconds(30);

// What changes with every commit (progress) lies apart from what may be large, and with room for
// the next version of each row in its page. Bodies are compressed or noise already. No id of a
// mission is given out twice, so that whoever still reads a mission that was removed meets no
// other.
constexpr const char* kTables[] = {
    ("CREATE TABLE IF NOT EXISTS plumescout_store(format bigint NOT NULL, id bigint NOT NULL, "
     "cluster text NOT NULL, single boolean PRIMARY KEY DEFAULT true CHECK (single))"),
    ("CREATE TABLE IF NOT EXISTS plumescout_node(id bigint PRIMARY KEY, name text NOT NULL UNIQUE, "
     "address text NOT NULL, expires timestamptz NOT NULL)"),
    ("CREATE TABLE IF NOT EXISTS plumescout_mission(id bigint PRIMARY KEY, key bytea NOT NULL "
     "UNIQUE, "
     "header bytea NOT NULL, crc bigint NOT NULL)"),
    ("CREATE TABLE IF NOT EXISTS plumescout_progress(mission bigint PRIMARY KEY, "
     "epoch bigint NOT NULL, head bigint NOT NULL, chain bigint NOT NULL, base bigint NOT NULL, "
     "base_chain bigint NOT NULL, bytes bigint NOT NULL, standing_crc bigint NOT NULL, "
     "writes bigint NOT NULL, crc bigint NOT NULL, owner bigint) WITH (fillfactor = 50)"),
    ("CREATE TABLE IF NOT EXISTS plumescout_standing(mission bigint PRIMARY KEY, "
     "bytes bytea NOT NULL)"),
    ("CREATE TABLE IF NOT EXISTS plumescout_record(mission bigint, number bigint, "
     "crc bigint NOT NULL, bytes bytea NOT NULL, PRIMARY KEY(mission, number))"),
    "ALTER TABLE plumescout_record ALTER COLUMN bytes SET STORAGE EXTERNAL",
    ("CREATE TABLE IF NOT EXISTS plumescout_snapshot(mission bigint, revision bigint, "
     "digest bigint NOT NULL, crc bigint NOT NULL, bytes bytea NOT NULL, "
     "PRIMARY KEY(mission, revision))"),
    "ALTER TABLE plumescout_snapshot ALTER COLUMN bytes SET STORAGE EXTERNAL",
    "CREATE TABLE IF NOT EXISTS plumescout_removed(mission bigint PRIMARY KEY)",
    "CREATE TABLE IF NOT EXISTS plumescout_probe(id bigint PRIMARY KEY, count bigint NOT NULL)",
    "CREATE SEQUENCE IF NOT EXISTS plumescout_ids",
    "INSERT INTO plumescout_probe VALUES(1, 0) ON CONFLICT DO NOTHING",
};

// When missions that nobody calls for are to go, whose calls come to the wrong node, and what is
// damaged. They came later than the others: a store without them gets them, and servers that do not
// know them leave them alone.
constexpr const char* kLaterTables[] = {
    ("CREATE TABLE IF NOT EXISTS plumescout_idle(mission bigint PRIMARY KEY, "
     "forget_at timestamptz NOT NULL)"),
    ("CREATE TABLE IF NOT EXISTS plumescout_stray(mission bigint PRIMARY KEY, "
     "owner bigint NOT NULL, came_to text NOT NULL, since timestamptz NOT NULL, "
     "seen timestamptz NOT NULL)"),
    ("CREATE TABLE IF NOT EXISTS plumescout_damage(mission bigint PRIMARY KEY, "
     "what text NOT NULL)"),
};

// As kTables, for whoever reads them again.
constexpr const char* kColumns[] = {
    "damage: mission bigint, what text",
    "idle: mission bigint, forget_at timestamp with time zone",
    "mission: id bigint, key bytea, header bytea, crc bigint",
    "node: id bigint, name text, address text, expires timestamp with time zone",
    "probe: id bigint, count bigint",
    ("progress: mission bigint, epoch bigint, head bigint, chain bigint, base bigint, "
     "base_chain bigint, bytes bigint, standing_crc bigint, writes bigint, crc bigint, owner "
     "bigint"),
    "record: mission bigint, number bigint, crc bigint, bytes bytea",
    "removed: mission bigint",
    "snapshot: mission bigint, revision bigint, digest bigint, crc bigint, bytes bytea",
    "standing: mission bigint, bytes bytea",
    "store: format bigint, id bigint, cluster text, single boolean",
    ("stray: mission bigint, owner bigint, came_to text, since timestamp with time zone, "
     "seen timestamp with time zone"),
};

// "PlumeScout" in ASCII, cut to eight bytes: of the lock that servers take while they make tables.
constexpr std::int64_t kMakingLock = 0x506C756D6553636F;

absl::Status IsReadOnly(const std::string& database) {
  return absl::FailedPreconditionError(absl::StrCat(database, " is read-only"));
}

absl::StatusOr<bool> HoldsStore(PostgresConnection& connection) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const PostgresRows rows,
      connection.Run(PostgresStatement("SELECT to_regclass('plumescout_store') IS NOT NULL, "
                                       "current_setting('transaction_read_only') = 'on'"),
                     kTimeout));
  if (rows.Int(0, 1) != 0) return IsReadOnly(connection.name());
  return rows.Int(0, 0) != 0;
}

absl::Status MakeTables(PostgresConnection& connection, const std::string& cluster) {
  std::vector<PostgresStatement> statements;
  statements.emplace_back("SELECT pg_advisory_xact_lock($1)").Bind(kMakingLock);
  for (const char* table : kTables) statements.emplace_back(table);
  statements
      .emplace_back(
          "INSERT INTO plumescout_store(format, id, cluster) "
          "VALUES($1, ('x' || left(md5(gen_random_uuid()::text), 16))::bit(64)::bigint, $2) "
          "ON CONFLICT DO NOTHING")
      .Bind(kSharedStoreFormat)
      .BindText(cluster);
  return connection.RunAll(statements, kTimeout).status();
}

absl::Status AddLaterTables(PostgresConnection& connection) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const PostgresRows rows,
      connection.Run(PostgresStatement("SELECT to_regclass('plumescout_idle') IS NOT NULL AND "
                                       "to_regclass('plumescout_stray') IS NOT NULL AND "
                                       "to_regclass('plumescout_damage') IS NOT NULL"),
                     kTimeout));
  if (rows.Int(0, 0) != 0) return absl::OkStatus();
  std::vector<PostgresStatement> statements;
  statements.emplace_back("SELECT pg_advisory_xact_lock($1)").Bind(kMakingLock);
  for (const char* table : kLaterTables) statements.emplace_back(table);
  return connection.RunAll(statements, kTimeout).status();
}

absl::Status CheckTables(PostgresConnection& connection) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const PostgresRows rows,
      connection.Run(
          PostgresStatement(
              "SELECT replace(table_name, 'plumescout_', '') || ': ' || string_agg(column_name || "
              "' ' || data_type, ', ' ORDER BY ordinal_position) FROM information_schema.columns "
              "WHERE table_schema = current_schema() AND table_name LIKE 'plumescout\\_%' "
              "GROUP BY table_name ORDER BY table_name COLLATE \"C\""),
          kTimeout));
  std::vector<std::string> found;
  for (int row = 0; row < rows.count(); ++row) found.push_back(rows.Bytes(row, 0));
  for (const char* columns : kColumns) {
    bool is_there = false;
    for (const std::string& table : found) is_there = is_there || table == columns;
    if (is_there) continue;
    return StoreDamaged(absl::StrCat(connection.name(), ": no table plumescout_", columns));
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::int64_t> OpenSharedSchema(PostgresConnection& connection,
                                              const std::string& cluster) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_made, HoldsStore(connection));
  if (!is_made) PLUMESCOUT_RETURN_IF_ERROR(MakeTables(connection, cluster));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const PostgresRows rows,
      connection.Run(PostgresStatement("SELECT format, id, cluster FROM plumescout_store"),
                     kTimeout));
  if (rows.count() != 1) {
    return StoreDamaged(
        absl::StrCat(connection.name(), ": plumescout_store has ", rows.count(), " rows, not 1"));
  }
  const std::int64_t format = rows.Int(0, 0);
  if (format != kSharedStoreFormat) {
    return absl::FailedPreconditionError(absl::StrCat(connection.name(), " has format ", format,
                                                      "; this program knows ", kSharedStoreFormat));
  }
  const std::string owner = rows.Bytes(0, 2);
  if (owner != cluster) {
    return absl::FailedPreconditionError(
        absl::StrCat(connection.name(), " is the store of the cluster ",
                     absl::Utf8SafeCHexEscape(owner), ", not of store.cluster = ", cluster));
  }
  PLUMESCOUT_RETURN_IF_ERROR(AddLaterTables(connection));
  PLUMESCOUT_RETURN_IF_ERROR(CheckTables(connection));
  return rows.Int(0, 1);
}

absl::Status CheckSameStore(PostgresConnection& connection, std::int64_t store,
                            absl::Duration timeout) {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const PostgresRows rows,
      connection.Run(PostgresStatement("SELECT id, current_setting('transaction_read_only') = 'on' "
                                       "FROM plumescout_store"),
                     timeout));
  if (rows.count() != 1 || rows.Int(0, 0) != store) {
    return StoreUnavailable(
        absl::StrCat(connection.name(), " holds another store than when this server started"));
  }
  if (rows.Int(0, 1) != 0) return StoreUnavailable(IsReadOnly(connection.name()).message());
  return absl::OkStatus();
}

}  // namespace plumescout::server
