// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_store.h"

#include <utility>

#include "absl/memory/memory.h"
#include "core/types/status_macros.h"
#include "server/store/postgres_connection.h"
#include "server/store/postgres_engine.h"
#include "server/store/postgres_missions.h"
#include "server/store/postgres_nodes.h"
#include "server/store/postgres_pool.h"
#include "server/store/postgres_reader.h"
#include "server/store/postgres_schema.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kFirstTimeout = absl::Seconds(10);

CommitterOptions SharedCommitterOptions(const PostgresStoreOptions& options) {
  CommitterOptions committer;
  committer.retry_period = options.retry_period;
  committer.slow_commit = options.slow_commit;
  committer.warn = options.warn;
  return committer;
}

std::unique_ptr<WriteEngine> MakeEngine(const std::string& url, std::int64_t store,
                                        std::shared_ptr<PostgresNodes> nodes) {
  PostgresEngineOptions options;
  options.url = url;
  options.store = store;
  options.lease = [nodes = std::move(nodes)] { return nodes->lease(); };
  return std::make_unique<PostgresEngine>(std::move(options));
}

}  // namespace

absl::StatusOr<std::unique_ptr<PostgresStore>> PostgresStore::Open(
    const PostgresStoreOptions& options) {
  std::int64_t store = 0;
  {
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto connection,
                                PostgresConnection::Open(options.url, kFirstTimeout));
    PLUMESCOUT_ASSIGN_OR_RETURN(store, OpenSharedSchema(*connection, options.cluster));
  }
  auto pool = std::make_shared<PostgresPool>(options.url, store);
  PostgresNodeOptions node;
  node.url = options.url;
  node.store = store;
  node.self = options.node;
  node.lease = options.lease;
  node.strays = options.strays;
  node.warn = options.warn;
  PLUMESCOUT_ASSIGN_OR_RETURN(std::shared_ptr<PostgresNodes> nodes,
                              PostgresNodes::Join(std::move(node), pool));
  return absl::WrapUnique(new PostgresStore(options, store, std::move(pool), std::move(nodes)));
}

PostgresStore::PostgresStore(const PostgresStoreOptions& options, std::int64_t store,
                             std::shared_ptr<PostgresPool> pool,
                             std::shared_ptr<PostgresNodes> nodes)
    : CommittedStore(SharedCommitterOptions(options), MakeEngine(options.url, store, nodes)),
      pool_(std::move(pool)),
      nodes_(std::move(nodes)) {}

PostgresStore::~PostgresStore() = default;

absl::StatusOr<std::unique_ptr<JournalReader>> PostgresStore::Read(const std::string& key,
                                                                   std::int64_t first_number) {
  PLUMESCOUT_ASSIGN_OR_RETURN(auto reader, PostgresReader::Open(pool_, key, first_number));
  return std::unique_ptr<JournalReader>(std::move(reader));
}

absl::StatusOr<AcquiredMission> PostgresStore::Peek(const std::string& key) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  PLUMESCOUT_ASSIGN_OR_RETURN(SharedMission mission, LoadSharedMission(*connection, key));
  return std::move(mission.known);
}

absl::StatusOr<std::vector<StoredMission>> PostgresStore::List() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  return ListSharedMissions(*connection);
}

std::int64_t PostgresStore::disk_bytes() const {
  // Whoever asks serves others, too, who must not wait for a database that is away.
  if (!state().status.ok() || !nodes_->status().ok()) return 0;
  const absl::StatusOr<PostgresPool::Loan> connection = pool_->Take();
  if (!connection.ok()) return 0;
  const absl::StatusOr<PostgresRows> rows =
      (*connection)
          ->Run(PostgresStatement("SELECT sum(pg_total_relation_size(oid))::bigint FROM pg_class "
                                  "WHERE relname LIKE 'plumescout\\_%' AND relkind = 'r' "
                                  "AND relnamespace = current_schema()::regnamespace"),
                kFirstTimeout);
  return rows.ok() ? rows->Int(0, 0) : 0;
}

StoreNodes* PostgresStore::nodes() { return nodes_.get(); }

}  // namespace plumescout::server
