// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

struct sqlite3;
struct sqlite3_stmt;

namespace plumescout::server {

class Database;

// A statement in use: parameters are bound in order, then it is stepped. Bytes that are bound must
// outlive it, and columns last until the next step.
class Query {
 public:
  Query(Database* database, sqlite3_stmt* statement, int code);
  ~Query();
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  Query& Bind(std::int64_t value);
  Query& BindText(absl::string_view text);
  Query& BindBlob(absl::string_view bytes);

  // Whether there is a row.
  absl::StatusOr<bool> Next();
  // To the end, without looking at rows.
  absl::Status Run();

  std::int64_t Int(int column) const;
  // Of text or a blob.
  std::string Bytes(int column) const;

 private:
  void Note(int code);

  Database* const database_;
  sqlite3_stmt* const statement_;
  int code_;  // the first error
  int bound_ = 0;
};

// A connection to a database in SQLite. Single-threaded.
//
// Errors name the file. kUnavailable (STORE_UNAVAILABLE): disk full, read errors, no rights and the
// like, worth another try on a new connection. kDataLoss (STORE_DAMAGED): it is no database, or not
// as it was written. kResourceExhausted: more than a row may hold.
class Database {
 public:
  enum class Access {
    kRead,  // and on closing the write-ahead log stays as it is
    kWrite,
    kMake  // unless it exists
  };

  static absl::StatusOr<std::unique_ptr<Database>> Open(const std::string& path, Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  const std::string& path() const { return path_; }

  // Prepared once for a text, which must be a constant, and used by one at a time.
  Query Use(const char* sql);
  // Statements without parameters, rows left aside.
  absl::Status Execute(const std::string& sql);
  // The first column of the first row; kDataLoss if there is none.
  absl::StatusOr<std::int64_t> GetInt(const char* sql);
  absl::StatusOr<std::string> GetText(const char* sql);

  std::int64_t last_insert_id() const;
  std::int64_t changes() const;  // rows, by the last statement

  // Copies the write-ahead log into the database as far as readers let it; with `whole` all of it,
  // and then empties it.
  absl::Status Checkpoint(bool whole);
  // Pages in the write-ahead log after the last commit of this connection.
  int logged_pages() const { return logged_pages_; }

  // Whether the last error was for want of room, with nothing left half-done.
  bool was_full() const { return was_full_; }
  absl::Status Error(int code);
  void RollBack();

 private:
  Database(std::string path, sqlite3* connection);

  absl::Status SetUp(Access access);

  const std::string path_;
  sqlite3* const connection_;
  std::map<const char*, sqlite3_stmt*> statements_;
  int logged_pages_ = 0;
  bool was_full_ = false;
};

// A transaction that is rolled back unless it was committed.
class Transaction {
 public:
  explicit Transaction(Database* database) : database_(database) {}
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  absl::Status Begin();
  // To read a single state of the database.
  absl::Status BeginToRead();
  absl::Status Commit();

 private:
  Database* const database_;
  bool is_open_ = false;
};

}  // namespace plumescout::server
