// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/database.h"

#include <sqlite3.h>

#include <utility>

#include "absl/memory/memory.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

constexpr int kBusyTimeout_ms = 2000;  // for another connection of ours
// 1000 pages: what 100 missions write to stays in memory.
constexpr char kWriterSetUp[] =
    "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA cache_size = -16384;"
    "PRAGMA wal_autocheckpoint = 0; PRAGMA journal_size_limit = 67108864";
constexpr char kReaderSetUp[] = "PRAGMA query_only = 1; PRAGMA cache_size = -1024";

enum class ErrorKind { kDisk, kDamage, kTooLarge };

ErrorKind KindOf(int extended_code) {
  constexpr int kPrimaryMask = 0xFF;
  if (extended_code == SQLITE_IOERR_CORRUPTFS) return ErrorKind::kDamage;
  switch (extended_code & kPrimaryMask) {
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_NOMEM:
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_PERM:
    case SQLITE_AUTH:
    case SQLITE_PROTOCOL:
    case SQLITE_INTERRUPT:
      return ErrorKind::kDisk;
    case SQLITE_TOOBIG:
      return ErrorKind::kTooLarge;
    default:
      return ErrorKind::kDamage;
  }
}

absl::Status ErrorOf(const std::string& path, int code, absl::string_view message) {
  const std::string what = absl::StrCat(path, ": ", message, " (SQLite error ", code, ")");
  switch (KindOf(code)) {
    case ErrorKind::kDisk:
      return StoreUnavailable(what);
    case ErrorKind::kDamage:
      return StoreDamaged(what);
    case ErrorKind::kTooLarge:
      return absl::ResourceExhaustedError(what);
  }
  return absl::InternalError(what);
}

}  // namespace

Query::Query(Database* database, sqlite3_stmt* statement, int code)
    : database_(database), statement_(statement), code_(code) {}

Query::~Query() {
  if (statement_ == nullptr) return;
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

Query& Query::Bind(std::int64_t value) {
  if (code_ == SQLITE_OK) Note(sqlite3_bind_int64(statement_, ++bound_, value));
  return *this;
}

Query& Query::BindText(absl::string_view text) {
  if (code_ == SQLITE_OK) {
    Note(sqlite3_bind_text64(statement_, ++bound_, text.data() == nullptr ? "" : text.data(),
                             text.size(), SQLITE_STATIC, SQLITE_UTF8));
  }
  return *this;
}

Query& Query::BindBlob(absl::string_view bytes) {
  if (code_ == SQLITE_OK) {
    Note(sqlite3_bind_blob64(statement_, ++bound_, bytes.data() == nullptr ? "" : bytes.data(),
                             bytes.size(), SQLITE_STATIC));
  }
  return *this;
}

absl::StatusOr<bool> Query::Next() {
  if (code_ != SQLITE_OK) return database_->Error(code_);
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  code_ = code;
  return database_->Error(code);
}

absl::Status Query::Run() {
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool has_row, Next());
    if (!has_row) return absl::OkStatus();
  }
}

std::int64_t Query::Int(int column) const { return sqlite3_column_int64(statement_, column); }

std::string Query::Bytes(int column) const {
  const void* const bytes = sqlite3_column_blob(statement_, column);
  const int size = sqlite3_column_bytes(statement_, column);
  if (bytes == nullptr || size <= 0) return "";
  return {static_cast<const char*>(bytes), static_cast<std::size_t>(size)};
}

void Query::Note(int code) {
  if (code_ == SQLITE_OK) code_ = code;
}

absl::StatusOr<std::unique_ptr<Database>> Database::Open(const std::string& path, Access access) {
  sqlite3* connection = nullptr;
  const int make = access == Access::kMake ? SQLITE_OPEN_CREATE : 0;
  const int code = sqlite3_open_v2(path.c_str(), &connection,
                                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX | make, nullptr);
  if (connection == nullptr) return ErrorOf(path, SQLITE_NOMEM, "out of memory");
  auto database = absl::WrapUnique(new Database(path, connection));
  sqlite3_extended_result_codes(connection, 1);
  if (code != SQLITE_OK) return database->Error(sqlite3_extended_errcode(connection));
  PLUMESCOUT_RETURN_IF_ERROR(database->SetUp(access));
  return database;
}

absl::Status Database::SetUp(Access access) {
  sqlite3_busy_timeout(connection_, kBusyTimeout_ms);
  if (access == Access::kMake) return Execute("PRAGMA synchronous = EXTRA");
  if (access == Access::kRead) {
    sqlite3_db_config(connection_, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    return Execute(kReaderSetUp);
  }
  PLUMESCOUT_RETURN_IF_ERROR(Execute(kWriterSetUp));
  sqlite3_wal_hook(
      connection_,
      [](void* database, sqlite3*, const char*, int pages) {
        static_cast<Database*>(database)->logged_pages_ = pages;
        return SQLITE_OK;
      },
      this);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string mode, GetText("PRAGMA journal_mode"));
  if (mode != "wal") return StoreUnavailable(absl::StrCat(path_, ": no write-ahead log here"));
  return absl::OkStatus();
}

Database::Database(std::string path, sqlite3* connection)
    : path_(std::move(path)), connection_(connection) {}

Database::~Database() {
  for (const auto& [sql, statement] : statements_) sqlite3_finalize(statement);
  sqlite3_close_v2(connection_);
}

Query Database::Use(const char* sql) {
  const auto [found, is_new] = statements_.try_emplace(sql, nullptr);
  int code = SQLITE_OK;
  if (is_new) {
    code = sqlite3_prepare_v3(connection_, sql, -1, SQLITE_PREPARE_PERSISTENT, &found->second,
                              nullptr);
  }
  if (code == SQLITE_OK) return {this, found->second, code};
  statements_.erase(found);
  return {this, nullptr, code};
}

absl::Status Database::Execute(const std::string& sql) {
  const int code = sqlite3_exec(connection_, sql.c_str(), nullptr, nullptr, nullptr);
  return code == SQLITE_OK ? absl::OkStatus() : Error(code);
}

absl::StatusOr<std::int64_t> Database::GetInt(const char* sql) {
  Query query = Use(sql);
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool has_row, query.Next());
  if (!has_row) return StoreDamaged(absl::StrCat(path_, ": no answer to ", sql));
  return query.Int(0);
}

absl::StatusOr<std::string> Database::GetText(const char* sql) {
  Query query = Use(sql);
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool has_row, query.Next());
  if (!has_row) return StoreDamaged(absl::StrCat(path_, ": no answer to ", sql));
  return query.Bytes(0);
}

std::int64_t Database::last_insert_id() const { return sqlite3_last_insert_rowid(connection_); }

std::int64_t Database::changes() const { return sqlite3_changes64(connection_); }

absl::Status Database::Checkpoint(bool whole) {
  int left = 0;
  const int mode = whole ? SQLITE_CHECKPOINT_TRUNCATE : SQLITE_CHECKPOINT_PASSIVE;
  const int code = sqlite3_wal_checkpoint_v2(connection_, "main", mode, &left, nullptr);
  if (code != SQLITE_OK) return Error(code);
  logged_pages_ = 0;
  return absl::OkStatus();
}

absl::Status Database::Error(int code) {
  const int extended = sqlite3_extended_errcode(connection_);
  was_full_ = code == SQLITE_FULL;
  const bool same = extended == code || (code & 0xFF) == (extended & 0xFF);
  return ErrorOf(path_, same ? extended : code,
                 same ? sqlite3_errmsg(connection_) : sqlite3_errstr(code));
}

void Database::RollBack() {
  // After some errors it has rolled back already, and says so.
  sqlite3_exec(connection_, "ROLLBACK", nullptr, nullptr, nullptr);
}

Transaction::~Transaction() {
  if (is_open_) database_->RollBack();
}

absl::Status Transaction::Begin() {
  PLUMESCOUT_RETURN_IF_ERROR(database_->Use("BEGIN IMMEDIATE").Run());
  is_open_ = true;
  return absl::OkStatus();
}

absl::Status Transaction::BeginToRead() {
  PLUMESCOUT_RETURN_IF_ERROR(database_->Use("BEGIN").Run());
  is_open_ = true;
  return absl::OkStatus();
}

absl::Status Transaction::Commit() {
  PLUMESCOUT_RETURN_IF_ERROR(database_->Use("COMMIT").Run());
  is_open_ = false;
  return absl::OkStatus();
}

}  // namespace plumescout::server
