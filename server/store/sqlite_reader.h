// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/database.h"
#include "server/store/head_marks.h"
#include "server/store/mission_rows.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// Reads a journal over a connection of its own, a page of records at a time, so that it holds
// neither much memory nor the database. Every record is checked against the chain of those before.
class SqliteReader final : public JournalReader {
 public:
  // As MissionStore::Read. kDataLoss also if the mission is shorter than its mark, taken before,
  // tells.
  static absl::StatusOr<std::unique_ptr<SqliteReader>> Open(const std::string& file,
                                                            const std::string& key,
                                                            std::int64_t first_number,
                                                            const KnownHead& known = {});

  // Also kNotFound if the mission was removed meanwhile.
  absl::StatusOr<std::optional<JournalRecord>> Next() override;

  const MissionRow& row() const { return row_; }  // as it was when the reader was opened

 private:
  explicit SqliteReader(std::unique_ptr<Database> database);

  absl::Status Begin(const std::string& key, std::int64_t first_number, const KnownHead& known);
  absl::Status FetchPage();
  absl::Status Damaged(std::int64_t number);

  const std::unique_ptr<Database> database_;
  MissionRows rows_;
  MissionRow row_;
  std::int64_t next_ = 1;    // to be given out
  std::uint32_t chain_ = 0;  // of the last one fetched
  std::deque<JournalRecord> page_;
};

}  // namespace plumescout::server
