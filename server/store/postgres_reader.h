// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/mission_row.h"
#include "server/store/mission_store.h"
#include "server/store/postgres_pool.h"

namespace plumescout::server {

// Reads a journal a page of records at a time, and holds a connection only meanwhile. Every record
// is checked against the chain of those before.
class PostgresReader final : public JournalReader {
 public:
  // As MissionStore::Read.
  static absl::StatusOr<std::unique_ptr<PostgresReader>> Open(std::shared_ptr<PostgresPool> pool,
                                                              const std::string& key,
                                                              std::int64_t first_number);

  // Also kNotFound if the mission was removed meanwhile.
  absl::StatusOr<std::optional<JournalRecord>> Next() override;

 private:
  explicit PostgresReader(std::shared_ptr<PostgresPool> pool) : pool_(std::move(pool)) {}

  absl::Status FetchPage();
  absl::Status Damaged(PostgresConnection& connection, std::int64_t number);

  const std::shared_ptr<PostgresPool> pool_;
  MissionRow row_;           // as it was when the reader was opened
  std::int64_t next_ = 1;    // to be given out
  std::uint32_t chain_ = 0;  // of the last one fetched
  std::deque<JournalRecord> page_;
};

}  // namespace plumescout::server
