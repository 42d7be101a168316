// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/open_store.h"

#include <string>

#include "core/types/status_macros.h"
#include "server/base/log.h"
#include "server/store/sqlite_store.h"

#ifdef PLUMESCOUT_POSTGRESQL
#include "server/store/postgres_connection.h"
#include "server/store/postgres_store.h"
#endif

namespace plumescout::server {
namespace {

void WarnOfStore(absl::string_view what) { LogWarning("store", {{"what", std::string(what)}}); }

#ifdef PLUMESCOUT_POSTGRESQL
absl::StatusOr<std::unique_ptr<MissionStore>> OpenShared(const StoreConfig& config,
                                                         const std::string& listen) {
  PostgresStoreOptions options;
  options.url = config.url;
  options.cluster = config.cluster;
  options.node = {config.node, config.advertise.empty() ? listen : config.advertise};
  options.lease = absl::Seconds(config.lease_s);
  options.slow_commit = absl::Seconds(config.slow_commit_s);
  options.warn = WarnOfStore;
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<MissionStore> store, PostgresStore::Open(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string database, PostgresName(config.url));
  LogInfo("store", {{"database", database}, {"cluster", config.cluster}, {"node", config.node}});
  return store;
}
#else
absl::StatusOr<std::unique_ptr<MissionStore>> OpenShared(const StoreConfig&, const std::string&) {
  return absl::InvalidArgumentError(
      "store.engine = postgresql: PostgreSQL is not built in, this server is built without it");
}
#endif

}  // namespace

bool HasPostgresql() {
#ifdef PLUMESCOUT_POSTGRESQL
  return true;
#else
  return false;
#endif
}

absl::StatusOr<std::unique_ptr<MissionStore>> OpenStore(const StoreConfig& config,
                                                        const std::string& listen) {
  if (config.engine == kNoStore) return nullptr;
  if (config.engine == kPostgresqlStore) return OpenShared(config, listen);
  StoreOptions options;
  PLUMESCOUT_ASSIGN_OR_RETURN(options.folder, StoreFolder(config));
  options.slow_commit = absl::Seconds(config.slow_commit_s);
  options.warn = WarnOfStore;
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<MissionStore> store, SqliteStore::Open(options));
  LogInfo("store", {{"folder", options.folder}});
  return store;
}

}  // namespace plumescout::server
