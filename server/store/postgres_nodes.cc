// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_nodes.h"

#include <algorithm>
#include <utility>

#include "absl/memory/memory.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "server/store/postgres_schema.h"
#include "server/store/postgres_strays.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kAskTimeout = absl::Seconds(5);
constexpr double kMargin = 0.1;  // of a lease: a node takes it for lost so much earlier

absl::Duration Until(SteadyTime limit) { return absl::FromChrono(limit - SteadyNow()); }

absl::Status NameTaken(const std::string& database, const StoreNode& self,
                       const std::string& address) {
  return absl::FailedPreconditionError(absl::StrCat(database, ": store.node = ", self.name,
                                                    " is another server that lives, at ", address));
}

}  // namespace

PostgresNodes::PostgresNodes(PostgresNodeOptions options, std::shared_ptr<PostgresPool> pool)
    : options_(std::move(options)), pool_(std::move(pool)) {}

absl::StatusOr<std::unique_ptr<PostgresNodes>> PostgresNodes::Join(
    PostgresNodeOptions options, std::shared_ptr<PostgresPool> pool) {
  auto nodes = absl::WrapUnique(new PostgresNodes(std::move(options), std::move(pool)));
  PLUMESCOUT_RETURN_IF_ERROR(nodes->JoinAtStart());
  nodes->thread_ = std::thread([raw = nodes.get()] { raw->Run(); });
  return nodes;
}

PostgresNodes::~PostgresNodes() {
  stop_.Stop();
  if (thread_.joinable()) thread_.join();
  if (lease() == 0 || !Connect(After(SteadyNow(), kAskTimeout)).ok()) return;
  PostgresStatement leave("DELETE FROM plumescout_node WHERE id = $1");
  connection_->Run(leave.Bind(lease()), kAskTimeout).status().IgnoreError();
}

absl::Status PostgresNodes::Connect(SteadyTime limit) {
  if (connection_ != nullptr && !connection_->is_broken()) return absl::OkStatus();
  connection_ = nullptr;
  PLUMESCOUT_ASSIGN_OR_RETURN(auto opened, PostgresConnection::Open(options_.url, Until(limit)));
  PLUMESCOUT_RETURN_IF_ERROR(CheckSameStore(*opened, options_.store, Until(limit)));
  connection_ = std::move(opened);
  return absl::OkStatus();
}

absl::StatusOr<std::optional<PostgresNodes::Holder>> PostgresNodes::TryJoin(std::int64_t old) {
  PLUMESCOUT_RETURN_IF_ERROR(Connect(After(SteadyNow(), kAskTimeout)));
  const SteadyTime begin = SteadyNow();
  std::vector<PostgresStatement> statements;
  statements
      .emplace_back(
          "DELETE FROM plumescout_node WHERE id = $1 OR (name = $2 AND expires <= "
          "clock_timestamp())")
      .Bind(old)
      .BindText(options_.self.name);
  statements
      .emplace_back(
          "INSERT INTO plumescout_node(id, name, address, expires) "
          "VALUES(nextval('plumescout_ids'), $1, $2, clock_timestamp() + $3 * interval '1 us') "
          "ON CONFLICT (name) DO NOTHING RETURNING id")
      .BindText(options_.self.name)
      .BindText(options_.self.address)
      .Bind(absl::ToInt64Microseconds(options_.lease));
  statements
      .emplace_back(
          "SELECT id, (extract(epoch FROM expires) * 1000000)::bigint, "
          "(extract(epoch FROM expires - clock_timestamp()) * 1000000)::bigint, address "
          "FROM plumescout_node WHERE name = $1")
      .BindText(options_.self.name);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<PostgresRows> answers,
                              connection_->RunAll(statements, kAskTimeout));
  if (answers[1].count() == 1) {
    Hold(answers[1].Int(0, 0), begin);
    return std::optional<Holder>();
  }
  const PostgresRows& other = answers[2];
  if (other.count() == 0) return std::optional<Holder>(Holder());  // gone just now
  Holder holder;
  holder.lease = other.Int(0, 0);
  holder.expires_us = other.Int(0, 1);
  holder.left = absl::Microseconds(other.Int(0, 2));
  holder.address = other.Bytes(0, 3);
  return std::optional<Holder>(std::move(holder));
}

absl::Status PostgresNodes::JoinAtStart() {
  std::optional<Holder> first;
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<Holder> holder, TryJoin(0));
    if (!holder.has_value()) return absl::OkStatus();
    const bool is_new = !first.has_value() || holder->lease == 0;
    const bool is_renewed =
        !is_new && (holder->lease != first->lease || holder->expires_us != first->expires_us);
    const bool is_long = holder->left > 2 * options_.lease + absl::Seconds(1);
    if (is_renewed || is_long) {
      return NameTaken(connection_->name(), options_.self, holder->address);
    }
    if (is_new) {
      options_.warn(absl::StrCat("waiting for the lease of a node ", options_.self.name, " at ",
                                 holder->address, " to run out"));
      first = *holder;
    }
    absl::SleepFor(std::clamp(holder->left, absl::Milliseconds(10), period()));
  }
}

void PostgresNodes::Hold(std::int64_t lease, SteadyTime begin) {
  absl::MutexLock lock(&mutex_);
  lease_ = lease;
  lease_until_ = After(begin, options_.lease * (1 - kMargin));
  status_ = absl::OkStatus();
}

absl::Status PostgresNodes::Renew() {
  // No answer is worth waiting for once the lease is over.
  const absl::Duration patience =
      std::clamp(options_.lease / 2, absl::Milliseconds(250), kAskTimeout);
  const SteadyTime limit = std::min(After(SteadyNow(), patience), lease_until());
  PLUMESCOUT_RETURN_IF_ERROR(Connect(limit));
  const SteadyTime begin = SteadyNow();
  const std::int64_t own = lease();
  PostgresStatement statement(
      "UPDATE plumescout_node SET expires = clock_timestamp() + $2 * interval '1 us' "
      "WHERE id = $1 AND expires > clock_timestamp() RETURNING id");
  statement.Bind(own).Bind(absl::ToInt64Microseconds(options_.lease));
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows, connection_->Run(statement, Until(limit)));
  if (rows.count() == 0) {
    return absl::AbortedError(absl::StrCat(connection_->name(), ": the lease of node ",
                                           options_.self.name, " has run out"));
  }
  Hold(own, begin);
  return absl::OkStatus();
}

absl::Status PostgresNodes::JoinAgain() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<Holder> holder, TryJoin(old_lease_));
  if (!holder.has_value()) {
    options_.warn("the node has a lease again");
  } else if (holder->lease != 0) {
    const absl::Status taken = NameTaken(connection_->name(), options_.self, holder->address);
    absl::MutexLock lock(&mutex_);
    status_ = StoreUnavailable(taken.message());
  }
  return absl::OkStatus();
}

void PostgresNodes::Run() {
  while (true) {
    const bool is_held = lease() != 0;
    const SteadyTime next = After(SteadyNow(), period());
    if (stop_.AwaitStop(is_held ? std::min(next, lease_until()) : next)) return;
    const absl::Status status = is_held ? Renew() : JoinAgain();
    if (!status.ok()) connection_ = nullptr;
    if (!is_held) continue;
    if (absl::IsAborted(status) || (!status.ok() && SteadyNow() >= lease_until())) Lose(status);
  }
}

void PostgresNodes::Lose(const absl::Status& why) {
  {
    absl::MutexLock lock(&mutex_);
    old_lease_ = lease_;
    lease_ = 0;
    lease_until_ = SteadyTime::min();
    status_ = absl::IsUnavailable(why) ? why : StoreUnavailable(why.message());
  }
  absl::MutexLock lock(&on_lost_mutex_);
  if (on_lost_) on_lost_(why);
}

std::int64_t PostgresNodes::lease() const {
  absl::MutexLock lock(&mutex_);
  return lease_;
}

SteadyTime PostgresNodes::lease_until() const {
  absl::MutexLock lock(&mutex_);
  return lease_until_;
}

absl::Status PostgresNodes::status() const {
  absl::MutexLock lock(&mutex_);
  if (!status_.ok() || SteadyNow() < lease_until_) return status_;
  return StoreUnavailable(
      absl::StrCat("the lease of node ", options_.self.name, " could not be renewed"));
}

void PostgresNodes::SetOnLost(OnLost on_lost) {
  absl::MutexLock lock(&on_lost_mutex_);
  on_lost_ = std::move(on_lost);
}

absl::StatusOr<std::vector<StoreNode>> PostgresNodes::ListLiving() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const PostgresRows rows,
      connection->Run(PostgresStatement("SELECT name, address FROM plumescout_node WHERE expires > "
                                        "clock_timestamp() ORDER BY name COLLATE \"C\""),
                      kAskTimeout));
  std::vector<StoreNode> nodes;
  for (int at = 0; at < rows.count(); ++at) nodes.push_back({rows.Bytes(at, 0), rows.Bytes(at, 1)});
  return nodes;
}

absl::StatusOr<std::optional<std::string>> PostgresNodes::FindOwner(const std::string& key) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  PostgresStatement statement(
      "SELECT n.name FROM plumescout_mission m JOIN plumescout_progress p ON p.mission = m.id "
      "LEFT JOIN plumescout_node n ON n.id = p.owner AND n.expires > clock_timestamp() "
      "WHERE m.key = $1");
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows,
                              connection->Run(statement.BindBytes(key), kAskTimeout));
  if (rows.count() == 0) return NotStored(key);
  if (rows.is_null(0, 0)) return std::optional<std::string>();
  return std::optional<std::string>(rows.Bytes(0, 0));
}

absl::StatusOr<std::vector<OwnedMission>> PostgresNodes::ListMissions(
    const OwnedMissionQuery& query) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  const std::string last_part = query.last_part.empty() ? "" : absl::StrCat("/", query.last_part);
  PostgresStatement statement(
      "SELECT m.key, n.name, d.what FROM plumescout_mission m "
      "LEFT JOIN plumescout_progress p ON p.mission = m.id "
      "LEFT JOIN plumescout_node n ON n.id = p.owner AND n.expires > clock_timestamp() "
      "LEFT JOIN plumescout_damage d ON d.mission = m.id "
      "WHERE m.key > $1 AND m.key >= $2 AND substr(m.key, 1, octet_length($2)) = $2 "
      "AND substr('\\x2f'::bytea || m.key, octet_length(m.key) + 2 - octet_length($3)) = $3 "
      "ORDER BY m.key LIMIT $4");
  statement.BindBytes(query.after).BindBytes(query.begins_with).BindBytes(last_part);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows,
                              connection->Run(statement.Bind(query.limit), kAskTimeout));
  std::vector<OwnedMission> missions;
  for (int at = 0; at < rows.count(); ++at)
    missions.push_back({rows.Bytes(at, 0), rows.Bytes(at, 1), rows.Bytes(at, 2)});
  return missions;
}

absl::Status PostgresNodes::NoteDamage(const std::string& key, const std::string& what) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  PostgresStatement statement(
      "INSERT INTO plumescout_damage(mission, what) SELECT id, $2 FROM plumescout_mission "
      "WHERE key = $1 ON CONFLICT (mission) DO UPDATE SET what = excluded.what");
  return connection->Run(statement.BindBytes(key).BindText(what), kAskTimeout).status();
}

absl::Status PostgresNodes::KeepFor(const std::vector<KeptMission>& missions) {
  std::vector<std::string> kept;
  std::vector<std::int64_t> kept_us;
  std::vector<std::string> for_good;
  for (const KeptMission& mission : missions) {
    if (mission.keep_for == absl::InfiniteDuration()) {
      for_good.push_back(mission.key);
    } else {
      kept.push_back(mission.key);
      kept_us.push_back(absl::ToInt64Microseconds(mission.keep_for));
    }
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  std::vector<PostgresStatement> statements;
  statements
      .emplace_back(
          "INSERT INTO plumescout_idle(mission, forget_at) "
          "SELECT m.id, clock_timestamp() + k.us * interval '1 us' "
          "FROM unnest($1::bytea[], $2::bigint[]) AS k(key, us) "
          "JOIN plumescout_mission m ON m.key = k.key "
          "JOIN plumescout_progress p ON p.mission = m.id AND p.owner = $3 ORDER BY m.id "
          "ON CONFLICT (mission) DO UPDATE SET forget_at = excluded.forget_at")
      .BindAllBytes(kept)
      .BindNumbers(kept_us)
      .Bind(lease());
  statements
      .emplace_back(
          "DELETE FROM plumescout_idle i USING plumescout_mission m, plumescout_progress p "
          "WHERE m.key = ANY($1) AND p.mission = m.id AND p.owner = $2 AND i.mission = m.id")
      .BindAllBytes(for_good)
      .Bind(lease());
  return connection->RunAll(statements, kAskTimeout).status();
}

absl::StatusOr<std::vector<ForgottenMission>> PostgresNodes::ListForgotten(int limit) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  PostgresStatement statement(
      "SELECT m.key, p.epoch FROM plumescout_idle i JOIN plumescout_mission m ON m.id = i.mission "
      "JOIN plumescout_progress p ON p.mission = m.id "
      "LEFT JOIN plumescout_node n ON n.id = p.owner AND n.expires > clock_timestamp() "
      "WHERE i.forget_at <= clock_timestamp() AND n.id IS NULL ORDER BY i.forget_at, m.key LIMIT "
      "$1");
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows,
                              connection->Run(statement.Bind(limit), kAskTimeout));
  std::vector<ForgottenMission> missions;
  for (int at = 0; at < rows.count(); ++at)
    missions.push_back({rows.Bytes(at, 0), rows.Int(at, 1)});
  return missions;
}

absl::Status PostgresNodes::NoteStrays(const std::vector<OwnedMission>& missions) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  return NoteSharedStrays(*connection, options_.strays, options_.self.name, missions);
}

absl::StatusOr<Strays> PostgresNodes::TakeStrays(int limit) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  return TakeSharedStrays(*connection, options_.strays, lease(), limit);
}

absl::Status PostgresNodes::Release(const std::string& key, std::int64_t epoch) {
  if (lease() == 0) return status();  // nothing is this node's any more
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  std::vector<PostgresStatement> statements;
  statements
      .emplace_back(
          "UPDATE plumescout_progress SET owner = NULL "
          "WHERE mission = (SELECT id FROM plumescout_mission WHERE key = $1) AND epoch = $2")
      .BindBytes(key)
      .Bind(epoch);
  statements
      .emplace_back(
          "SELECT p.epoch FROM plumescout_mission m JOIN plumescout_progress p ON p.mission = m.id "
          "WHERE m.key = $1")
      .BindBytes(key);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<PostgresRows> answers,
                              connection->RunAll(statements, kAskTimeout));
  if (answers[1].count() == 0) return NotStored(key);
  const std::int64_t newest = answers[1].Int(0, 0);
  return newest == epoch ? absl::OkStatus() : FencedByEpoch(key, epoch, newest);
}

}  // namespace plumescout::server
