// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_changes.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"

namespace plumescout::server {
namespace {

// The row is what it was thought to be, and becomes another.
constexpr absl::string_view kMoved =
    "WITH moved AS (UPDATE plumescout_progress SET epoch = $6, head = $7, chain = $8, base = $9, "
    "base_chain = $10, bytes = $11, standing_crc = $12, writes = $13, crc = $14 "
    "WHERE mission = $1 AND epoch = $2 AND head = $3 AND writes = $4 AND crc = $5 "
    "RETURNING mission)";

// The row is what it was thought to be, and is gone: the end is open for who else has to agree.
constexpr absl::string_view kProgressGone =
    "WITH gone AS (DELETE FROM plumescout_progress WHERE mission = $1 AND epoch = $2 "
    "AND head = $3 AND writes = $4 AND crc = $5";
// So is all else that is kept of the mission in `gone`; its records are for chores.
constexpr absl::string_view kAllGone =
    "m AS (DELETE FROM plumescout_mission m USING gone WHERE m.id = gone.mission), "
    "s AS (DELETE FROM plumescout_standing s USING gone WHERE s.mission = gone.mission), "
    "n AS (DELETE FROM plumescout_snapshot n USING gone WHERE n.mission = gone.mission), "
    "i AS (DELETE FROM plumescout_idle i USING gone WHERE i.mission = gone.mission), "
    "d AS (DELETE FROM plumescout_damage d USING gone WHERE d.mission = gone.mission), "
    "r AS (INSERT INTO plumescout_removed SELECT mission FROM gone) "
    "SELECT count(*) FROM gone";

// kMoved and what is done beside it, with $1 to $14 bound.
PostgresStatement Moving(absl::string_view beside, const MissionRow& before,
                         const MissionRow& after) {
  PostgresStatement statement(absl::StrCat(kMoved, beside, " SELECT count(*) FROM moved"));
  statement.Bind(before.id).Bind(before.epoch).Bind(before.head).Bind(before.writes);
  statement.Bind(RowChecksum(before));
  statement.Bind(after.epoch).Bind(after.head).Bind(after.chain).Bind(after.base);
  statement.Bind(after.base_chain).Bind(after.bytes).Bind(after.standing_crc);
  statement.Bind(after.writes).Bind(RowChecksum(after));
  return statement;
}

}  // namespace

PostgresStatement CreateStatement(const MissionRow& made, const std::string& header,
                                  std::int64_t owner) {
  PostgresStatement statement(
      "WITH made AS (INSERT INTO plumescout_mission(id, key, header, crc) SELECT $1, $2, $3, $4 "
      "WHERE EXISTS (SELECT FROM plumescout_node n WHERE n.id = $10 "
      "AND n.expires > clock_timestamp()) ON CONFLICT (key) DO NOTHING RETURNING id), "
      "begun AS (INSERT INTO plumescout_progress(mission, epoch, head, chain, base, base_chain, "
      "bytes, standing_crc, writes, crc, owner) "
      "SELECT id, $5, 0, $4, 0, 0, $6, $7, $8, $9, $10 FROM made) SELECT count(*) FROM made");
  statement.Bind(made.id).BindBytes(made.key).BindBytes(header).Bind(made.chain).Bind(made.epoch);
  statement.Bind(made.bytes).Bind(made.standing_crc).Bind(made.writes).Bind(RowChecksum(made));
  statement.Bind(owner);
  return statement;
}

PostgresStatement AcquireStatement(const MissionRow& before, const MissionRow& after,
                                   std::int64_t owner) {
  PostgresStatement statement(
      "WITH moved AS (UPDATE plumescout_progress SET epoch = $6, writes = $7, crc = $8, owner = $9 "
      "WHERE mission = $1 AND epoch = $2 AND head = $3 AND writes = $4 AND crc = $5 "
      "AND (owner IS NULL OR owner = $9 OR NOT EXISTS "
      "(SELECT FROM plumescout_node n WHERE n.id = owner)) AND EXISTS (SELECT FROM "
      "plumescout_node n WHERE n.id = $9 AND n.expires > clock_timestamp()) RETURNING mission), "
      "used AS (DELETE FROM plumescout_idle i USING moved WHERE i.mission = moved.mission), "
      "mended AS (DELETE FROM plumescout_damage d USING moved WHERE d.mission = moved.mission) "
      "SELECT count(*) FROM moved");
  statement.Bind(before.id).Bind(before.epoch).Bind(before.head).Bind(before.writes);
  statement.Bind(RowChecksum(before)).Bind(after.epoch).Bind(after.writes);
  statement.Bind(RowChecksum(after)).Bind(owner);
  return statement;
}

PostgresStatement AppendStatement(const MissionRow& before, const MissionRow& after,
                                  std::span<const std::string> records) {
  std::vector<std::int64_t> numbers;
  std::vector<std::int64_t> chains;
  std::uint32_t chain = before.chain;
  for (const std::string& record : records) {
    numbers.push_back(before.head + static_cast<std::int64_t>(numbers.size()) + 1);
    chain = ChainChecksum(chain, numbers.back(), record);
    chains.push_back(chain);
  }
  PostgresStatement statement = Moving(
      ", added AS (INSERT INTO plumescout_record(mission, number, crc, bytes) "
      "SELECT moved.mission, r.number, r.crc, r.bytes FROM moved, "
      "unnest($15::bigint[], $16::bigint[], $17::bytea[]) AS r(number, crc, bytes))",
      before, after);
  statement.BindNumbers(numbers).BindNumbers(chains).BindAllBytes(records).Keep();
  return statement;
}

PostgresStatement StandingStatement(const MissionRow& before, const MissionRow& after,
                                    const std::string& standing) {
  PostgresStatement statement = Moving(
      ", put AS (INSERT INTO plumescout_standing(mission, bytes) SELECT mission, $15 FROM moved "
      "ON CONFLICT (mission) DO UPDATE SET bytes = excluded.bytes)",
      before, after);
  statement.BindBytes(standing);
  return statement;
}

PostgresStatement SnapshotStatement(const MissionRow& before, const MissionRow& after,
                                    const StoredSnapshot& snapshot,
                                    std::span<const std::int64_t> leaving) {
  PostgresStatement statement = Moving(
      ", gone AS (DELETE FROM plumescout_snapshot s USING moved "
      "WHERE s.mission = moved.mission AND s.revision = ANY($15)), "
      "put AS (INSERT INTO plumescout_snapshot(mission, revision, digest, crc, bytes) "
      "SELECT mission, $16, $17, $18, $19 FROM moved ON CONFLICT (mission, revision) DO UPDATE "
      "SET digest = excluded.digest, crc = excluded.crc, bytes = excluded.bytes)",
      before, after);
  statement.BindNumbers(leaving).Bind(snapshot.revision);
  statement.Bind(static_cast<std::int64_t>(snapshot.digest));
  statement.Bind(SnapshotChecksum(before.id, snapshot)).BindBytes(snapshot.bytes);
  return statement;
}

PostgresStatement ForgetStatement(std::int64_t lease) {
  PostgresStatement statement(
      "DELETE FROM plumescout_node WHERE id = $1 AND expires <= clock_timestamp()");
  statement.Bind(lease);
  return statement;
}

PostgresStatement SaveStatement(const MissionRow& before, const MissionRow& after) {
  return Moving("", before, after);
}

PostgresStatement RemoveStatement(const MissionRow& before) {
  PostgresStatement statement(absl::StrCat(kProgressGone, " RETURNING mission), ", kAllGone));
  statement.Bind(before.id).Bind(before.epoch).Bind(before.head).Bind(before.writes);
  statement.Bind(RowChecksum(before));
  return statement;
}

PostgresStatement DiscardStatement(const DamagedRow& before, std::int64_t owner) {
  if (!before.has_progress) {
    PostgresStatement statement(absl::StrCat(
        "WITH gone AS (SELECT id AS mission FROM plumescout_mission WHERE id = $1 AND NOT EXISTS "
        "(SELECT FROM plumescout_progress WHERE mission = $1)), ",
        kAllGone));
    statement.Bind(before.id);
    return statement;
  }
  PostgresStatement statement(
      absl::StrCat(kProgressGone,
                   " AND (owner IS NULL OR owner = $6 OR NOT EXISTS (SELECT FROM plumescout_node n "
                   "WHERE n.id = owner AND n.expires > clock_timestamp())) RETURNING mission), ",
                   kAllGone));
  statement.Bind(before.id).Bind(before.epoch).Bind(before.head).Bind(before.writes);
  statement.Bind(before.crc).Bind(owner);
  return statement;
}

std::vector<PostgresStatement> PurgeStatements(std::int64_t limit) {
  std::vector<PostgresStatement> statements;
  for (const char* of : {"plumescout_removed p JOIN plumescout_record r ON r.mission = p.mission",
                         "plumescout_progress p JOIN plumescout_record r "
                         "ON r.mission = p.mission AND r.number <= p.base"}) {
    statements
        .emplace_back(
            absl::StrCat("WITH next AS (SELECT r.mission, r.number FROM ", of,
                         " LIMIT $1 FOR UPDATE OF r SKIP LOCKED), "
                         "gone AS (DELETE FROM plumescout_record r USING next "
                         "WHERE r.mission = next.mission AND r.number = next.number RETURNING 1) "
                         "SELECT count(*) FROM gone"))
        .Bind(limit);
  }
  statements.emplace_back(
      "DELETE FROM plumescout_removed d WHERE NOT EXISTS "
      "(SELECT FROM plumescout_record r WHERE r.mission = d.mission)");
  return statements;
}

}  // namespace plumescout::server
