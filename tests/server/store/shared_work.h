// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "server/store/postgres_store.h"
#include "tests/support/postgres_server.h"

namespace plumescout::server {

// A node of this name that waits little.
inline PostgresStoreOptions SharedOptions(const std::string& url, const std::string& node = "n1") {
  PostgresStoreOptions options;
  options.url = url;
  options.cluster = "tests";
  options.node = {node, node + ".example:1"};
  options.lease = absl::Seconds(60);
  options.retry_period = absl::Milliseconds(10);
  return options;
}

inline std::unique_ptr<PostgresStore> OpenShared(const std::string& url,
                                                 const std::string& node = "n1") {
  return PostgresStore::Open(SharedOptions(url, node)).value();
}

// As if nobody had renewed it for so long.
inline void ExpireLease(const std::string& url, const std::string& node) {
  PostgresServer::Shared().Ask(url,
                               "UPDATE plumescout_node SET expires = now() - interval '1 s' "
                               "WHERE name = '" +
                                   node + "'");
}

// Waits until it is so; false: it never was.
template <typename Condition>
bool Eventually(const Condition& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition()) return true;
    absl::SleepFor(absl::Milliseconds(10));
  }
  return false;
}

}  // namespace plumescout::server
