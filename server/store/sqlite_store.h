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

namespace plumescout::server {

class SqliteEngine;

struct StoreOptions {
  std::string folder;  // made unless it stands; nobody else may have it meanwhile
  absl::Duration retry_period = absl::Milliseconds(200);  // of what the disk refused
  absl::Duration slow_commit = absl::Seconds(1);          // who takes longer is warned of
  int max_batch_records = 1000;                           // in one transaction
  std::int64_t max_batch_bytes = 8 << 20;
  // The database has lost its end, or is an old copy, and the operator goes on with what it has:
  // missions that are shorter than they are known to have been are opened all the same.
  bool accept_loss = false;
  // Hears what an operator should know, in a line. Must not block.
  std::function<void(absl::string_view)> warn = [](absl::string_view) {};
};

// Missions in a database in a folder. What was told durable survives the process, and the power if
// the disk keeps what it was made to sync.
class SqliteStore final : public CommittedStore {
 public:
  // Errors name the folder or file. kFailedPrecondition: somebody else has it (and who), it is
  // another program's, or of a newer format. kPermissionDenied, kUnavailable: as the system says.
  // kDataLoss: it is damaged.
  static absl::StatusOr<std::unique_ptr<SqliteStore>> Open(const StoreOptions& options);

  absl::StatusOr<std::unique_ptr<JournalReader>> Read(const std::string& key,
                                                      std::int64_t first_number) override;
  absl::StatusOr<AcquiredMission> Peek(const std::string& key) override;
  // Also those that the database has lost: Acquire says so.
  absl::StatusOr<std::vector<StoredMission>> List() override;
  std::int64_t disk_bytes() const override;
  bool is_durable() const override { return true; }

  // Gives the room of removed missions back to the system, in small steps between commits. Blocks.
  absl::Status Compact();

 private:
  SqliteStore(const StoreOptions& options, const SqliteEngine* engine,
              std::unique_ptr<WriteEngine> owned);

  const std::string folder_;
  const SqliteEngine* const engine_;  // for what is thread-safe of it
};

}  // namespace plumescout::server
