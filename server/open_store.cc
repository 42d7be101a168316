// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/open_store.h"

#include <string>

#include "core/types/status_macros.h"
#include "server/base/log.h"
#include "server/store/sqlite_store.h"

namespace plumescout::server {

absl::StatusOr<std::unique_ptr<MissionStore>> OpenStore(const StoreConfig& config,
                                                        const std::string&) {
  if (config.engine == kNoStore) return nullptr;
  if (config.engine == kPostgresqlStore) {
    return absl::InvalidArgumentError(
        "store.engine = postgresql: PostgreSQL is not built in, this server is built without it");
  }
  StoreOptions options;
  PLUMESCOUT_ASSIGN_OR_RETURN(options.folder, StoreFolder(config));
  options.slow_commit = absl::Seconds(config.slow_commit_s);
  options.warn = [](absl::string_view what) { LogWarning("store", {{"what", std::string(what)}}); };
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<MissionStore> store, SqliteStore::Open(options));
  LogInfo("store", {{"folder", options.folder}});
  return store;
}

}  // namespace plumescout::server
