// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_reader.h"

#include <algorithm>
#include <vector>

#include "absl/memory/memory.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/postgres_missions.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

constexpr std::int64_t kSharedPageRecords = 256;
constexpr std::int64_t kSharedPageBytes = 1 << 20;  // and what the last record takes
constexpr absl::Duration kPageTimeout = absl::Seconds(30);

}  // namespace

absl::StatusOr<std::unique_ptr<PostgresReader>> PostgresReader::Open(
    std::shared_ptr<PostgresPool> pool, const std::string& key, std::int64_t first_number) {
  if (first_number < 1) return BadFirstNumber(first_number);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool->Take());
  const std::string keys[] = {key};
  PLUMESCOUT_ASSIGN_OR_RETURN(auto rows, LoadSharedRows(*connection, keys));
  const auto found = rows.find(key);
  if (found == rows.end()) return NotStored(key);
  PLUMESCOUT_RETURN_IF_ERROR(found->second.status());
  auto reader = absl::WrapUnique(new PostgresReader(std::move(pool)));
  reader->row_ = found->second->row;
  reader->next_ = first_number;
  const MissionRow& row = reader->row_;
  if (first_number <= row.base) return NotKept(key, row.base);
  if (first_number > row.head) return reader;
  const std::int64_t before[] = {first_number - 1};
  absl::StatusOr<std::vector<std::uint32_t>> chains = SharedChainsAt(*connection, row, before);
  if (absl::IsDataLoss(chains.status())) return reader->Damaged(*connection, first_number - 1);
  PLUMESCOUT_RETURN_IF_ERROR(chains.status());
  reader->chain_ = chains->front();
  return reader;
}

absl::StatusOr<std::optional<JournalRecord>> PostgresReader::Next() {
  if (next_ > row_.head) return std::optional<JournalRecord>();
  if (page_.empty()) PLUMESCOUT_RETURN_IF_ERROR(FetchPage());
  std::optional<JournalRecord> record = std::move(page_.front());
  page_.pop_front();
  next_ = record->number + 1;
  return record;
}

absl::Status PostgresReader::FetchPage() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresPool::Loan connection, pool_->Take());
  PostgresStatement statement(
      "SELECT number, crc, bytes FROM (SELECT number, crc, bytes, "
      "sum(octet_length(bytes)) OVER (ORDER BY number) - octet_length(bytes) AS before "
      "FROM plumescout_record WHERE mission = $1 AND number BETWEEN $2 AND $3) page "
      "WHERE before < $4 ORDER BY number");
  const std::int64_t last = std::min(row_.head, next_ + kSharedPageRecords - 1);
  statement.Bind(row_.id).Bind(next_).Bind(last).Bind(kSharedPageBytes);
  PLUMESCOUT_ASSIGN_OR_RETURN(const PostgresRows rows, connection->Run(statement, kPageTimeout));
  if (rows.count() == 0) return Damaged(*connection, next_);
  std::int64_t number = next_;
  for (int at = 0; at < rows.count(); ++at, ++number) {
    JournalRecord record = {rows.Int(at, 0), rows.Bytes(at, 2)};
    const std::uint32_t chain = ChainChecksum(chain_, number, record.bytes);
    const bool is_whole = record.number == number && rows.Int(at, 1) == chain &&
                          (number < row_.head || chain == row_.chain);
    // What is good before it is given out first.
    if (!is_whole) return page_.empty() ? Damaged(*connection, number) : absl::OkStatus();
    chain_ = chain;
    page_.push_back(std::move(record));
  }
  return absl::OkStatus();
}

absl::Status PostgresReader::Damaged(PostgresConnection& connection, std::int64_t number) {
  const std::string keys[] = {row_.key};
  PLUMESCOUT_ASSIGN_OR_RETURN(auto rows, LoadSharedRows(connection, keys));
  const auto found = rows.find(row_.key);
  if (found == rows.end()) return NotStored(row_.key);
  PLUMESCOUT_RETURN_IF_ERROR(found->second.status());
  const MissionRow& row = found->second->row;
  if (row.id != row_.id) return NotStored(row_.key);
  if (number <= row.base) return NotKept(row_.key, row.base);
  return SharedRowDamaged(connection, row_.key, absl::StrCat("record ", number));
}

}  // namespace plumescout::server
