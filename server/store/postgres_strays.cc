// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_strays.h"

#include "absl/time/time.h"
#include "core/types/status_macros.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kStrayTimeout = absl::Seconds(5);

}  // namespace

absl::Status NoteSharedStrays(PostgresConnection& connection, const StrayRules& rules,
                              const std::string& self, const std::vector<OwnedMission>& missions) {
  std::vector<std::string> keys;
  std::vector<std::string> nodes;
  for (const OwnedMission& mission : missions) {
    keys.push_back(mission.key);
    nodes.push_back(mission.node);
  }
  // `since` is ahead of now while a mission rests that has moved.
  PostgresStatement statement(
      "INSERT INTO plumescout_stray AS t(mission, owner, came_to, since, seen) "
      "SELECT m.id, n.id, $3, clock_timestamp(), clock_timestamp() "
      "FROM unnest($1::bytea[], $2::bytea[]) AS s(key, node) "
      "JOIN plumescout_mission m ON m.key = s.key "
      "JOIN plumescout_progress p ON p.mission = m.id "
      "JOIN plumescout_node n ON n.id = p.owner AND n.expires > clock_timestamp() "
      "AND convert_to(n.name, 'UTF8') = s.node ORDER BY m.id "
      "ON CONFLICT (mission) DO UPDATE SET owner = excluded.owner, came_to = excluded.came_to, "
      "seen = excluded.seen, since = CASE WHEN t.since > excluded.seen OR (t.owner = "
      "excluded.owner AND t.seen > excluded.seen - $4 * interval '1 us') "
      "THEN t.since ELSE excluded.since END");
  statement.BindAllBytes(keys).BindAllBytes(nodes).BindText(self);
  statement.Bind(absl::ToInt64Microseconds(rules.gap));
  return connection.Run(statement, kStrayTimeout).status();
}

absl::StatusOr<Strays> TakeSharedStrays(PostgresConnection& connection, const StrayRules& rules,
                                        std::int64_t lease, int limit) {
  std::vector<PostgresStatement> statements;
  statements
      .emplace_back(
          "UPDATE plumescout_stray t SET since = clock_timestamp() + $4 * interval '1 us' "
          "FROM plumescout_mission m JOIN plumescout_progress p ON p.mission = m.id "
          "WHERE m.id = t.mission AND t.mission IN (SELECT s.mission FROM plumescout_stray s "
          "JOIN plumescout_progress o ON o.mission = s.mission AND o.owner = s.owner "
          "WHERE s.owner = $1 AND s.seen >= s.since + $2 * interval '1 us' "
          "AND s.seen > clock_timestamp() - $3 * interval '1 us' ORDER BY s.since LIMIT $5) "
          "RETURNING m.key, p.epoch, t.came_to")
      .Bind(lease)
      .Bind(absl::ToInt64Microseconds(rules.lasts))
      .Bind(absl::ToInt64Microseconds(rules.gap))
      .Bind(absl::ToInt64Microseconds(rules.rests))
      .Bind(limit);
  statements
      .emplace_back(
          "SELECT DISTINCT n.name COLLATE \"C\" FROM plumescout_stray t "
          "JOIN plumescout_node n ON n.id = t.owner AND n.expires > clock_timestamp() "
          "WHERE t.seen > clock_timestamp() - $1 * interval '1 us' ORDER BY 1")
      .Bind(absl::ToInt64Microseconds(rules.shown));
  statements
      .emplace_back(
          "DELETE FROM plumescout_stray WHERE greatest(seen, since) < clock_timestamp() - $1 * "
          "interval '1 us'")
      .Bind(absl::ToInt64Microseconds(rules.shown));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<PostgresRows> answers,
                              connection.RunAll(statements, kStrayTimeout));
  Strays strays;
  for (int at = 0; at < answers[0].count(); ++at) {
    strays.missions.push_back(
        {answers[0].Bytes(at, 0), answers[0].Int(at, 1), answers[0].Bytes(at, 2)});
  }
  for (int at = 0; at < answers[1].count(); ++at) {
    strays.unreached.push_back(answers[1].Bytes(at, 0));
  }
  return strays;
}

}  // namespace plumescout::server
