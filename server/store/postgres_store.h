// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "server/store/committed_store.h"
#include "server/store/store_nodes.h"

namespace plumescout::server {

class PostgresNodes;
class PostgresPool;

struct PostgresStoreOptions {
  std::string url;      // postgresql://user@host:port/database
  std::string cluster;  // whose store it is; servers of other clusters are refused
  StoreNode node;       // this server
  absl::Duration lease = absl::Seconds(10);
  StrayRules strays = {};
  absl::Duration retry_period = absl::Milliseconds(200);  // of what the database refused
  absl::Duration slow_commit = absl::Seconds(1);          // who takes longer is warned of
  // Hears what an operator should know, in a line. Must not block.
  std::function<void(absl::string_view)> warn = [](absl::string_view) {};
};

// Missions in a database in PostgreSQL that several servers share. What was told durable survives
// the database's process, and whatever else its operators have made it survive.
class PostgresStore final : public CommittedStore {
 public:
  // Makes the tables unless they stand. Errors of PostgresConnection::Open, OpenSharedSchema and
  // PostgresNodes::Join.
  static absl::StatusOr<std::unique_ptr<PostgresStore>> Open(const PostgresStoreOptions& options);
  ~PostgresStore() override;

  absl::StatusOr<std::unique_ptr<JournalReader>> Read(const std::string& key,
                                                      std::int64_t first_number) override;
  absl::StatusOr<AcquiredMission> Peek(const std::string& key) override;
  absl::StatusOr<std::vector<StoredMission>> List() override;
  // Of the tables, with those of other servers' missions; 0 while the database is away.
  std::int64_t disk_bytes() const override;
  bool is_durable() const override { return true; }
  StoreNodes* nodes() override;

 private:
  PostgresStore(const PostgresStoreOptions& options, std::int64_t store,
                std::shared_ptr<PostgresPool> pool, std::shared_ptr<PostgresNodes> nodes);

  const std::shared_ptr<PostgresPool> pool_;
  const std::shared_ptr<PostgresNodes> nodes_;  // with the engine
};

}  // namespace plumescout::server
