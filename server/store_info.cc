// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_info.h"

#include <string>

namespace plumescout::server {

v1::StoreInfo TellOfStore(const StoreConfig& config, const MissionStore* store,
                          const StoreUsage* usage, const StrayFigures& strays) {
  v1::StoreInfo info;
  info.set_engine(config.engine);
  if (config.engine == kPostgresqlStore) {
    info.set_node(config.node);
    info.set_cluster(config.cluster);
  }
  if (store == nullptr) return info;
  const StoreState state = store->state();
  info.set_available(state.status.ok());
  info.set_trouble(std::string(state.status.message()));
  info.set_backlog_bytes(state.backlog_bytes);
  for (const std::string& node : strays.unreached) info.add_unreached_nodes(node);
  if (usage == nullptr) return info;
  for (const auto& [key, bytes] : usage->sizes().mission_bytes) {
    info.set_stored_bytes(info.stored_bytes() + bytes);
  }
  return info;
}

}  // namespace plumescout::server
