// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/sqlite_reader.h"

#include <utility>

#include "absl/memory/memory.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/checksum.h"
#include "server/store/mission_check.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

constexpr std::size_t kPageRecords = 256;
constexpr std::size_t kPageBytes = 1 << 20;  // and what the last record takes

}  // namespace

absl::StatusOr<std::unique_ptr<SqliteReader>> SqliteReader::Open(const std::string& file,
                                                                 const std::string& key,
                                                                 std::int64_t first_number,
                                                                 const KnownHead& known) {
  if (first_number < 1) return BadFirstNumber(first_number);
  PLUMESCOUT_ASSIGN_OR_RETURN(auto database, Database::Open(file, Database::Access::kRead));
  auto reader = absl::WrapUnique(new SqliteReader(std::move(database)));
  PLUMESCOUT_RETURN_IF_ERROR(reader->Begin(key, first_number, known));
  return reader;
}

SqliteReader::SqliteReader(std::unique_ptr<Database> database)
    : database_(std::move(database)), rows_(database_.get()) {}

absl::Status SqliteReader::Begin(const std::string& key, std::int64_t first_number,
                                 const KnownHead& known) {
  Transaction transaction(database_.get());
  PLUMESCOUT_RETURN_IF_ERROR(transaction.BeginToRead());
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<MissionRow> row, rows_.Find(key));
  if (!row.has_value()) return WhyAbsent(key, database_->path(), known);
  PLUMESCOUT_RETURN_IF_ERROR(CheckAgainstMark(rows_, *row, known));
  row_ = *row;
  next_ = first_number;
  if (next_ <= row_.base) return NotKept(key, row_.base);
  if (next_ > row_.head) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(chain_, rows_.ChainAt(row_, next_ - 1));
  return absl::OkStatus();
}

absl::StatusOr<std::optional<JournalRecord>> SqliteReader::Next() {
  if (next_ > row_.head) return std::optional<JournalRecord>();
  if (page_.empty()) PLUMESCOUT_RETURN_IF_ERROR(FetchPage());
  std::optional<JournalRecord> record = std::move(page_.front());
  page_.pop_front();
  next_ = record->number + 1;
  return record;
}

absl::Status SqliteReader::FetchPage() {
  Query query = database_->Use(
      "SELECT number, crc, bytes FROM record WHERE mission = ? AND number BETWEEN ? AND ? "
      "ORDER BY number");
  query.Bind(row_.id).Bind(next_).Bind(row_.head);
  std::size_t bytes = 0;
  std::int64_t number = next_;
  while (page_.size() < kPageRecords && bytes < kPageBytes && number <= row_.head) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool has_row, query.Next());
    JournalRecord record;
    if (has_row) record = {query.Int(0), query.Bytes(2)};
    const std::uint32_t chain = ChainChecksum(chain_, number, record.bytes);
    const bool is_whole = has_row && record.number == number && query.Int(1) == chain &&
                          (number < row_.head || chain == row_.chain);
    // What is good before it is given out first.
    if (!is_whole) return page_.empty() ? Damaged(number) : absl::OkStatus();
    chain_ = chain;
    bytes += record.bytes.size();
    page_.push_back(std::move(record));
    ++number;
  }
  return absl::OkStatus();
}

absl::Status SqliteReader::Damaged(std::int64_t number) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<MissionRow> row, rows_.Find(row_.key));
  if (!row.has_value() || row->id != row_.id) return NotStored(row_.key);
  if (number <= row->base) return NotKept(row_.key, row->base);
  return StoreDamaged(absl::StrCat(database_->path(), ": record ", number, " of mission ",
                                   absl::CHexEscape(row_.key), " is not what was written"));
}

}  // namespace plumescout::server
