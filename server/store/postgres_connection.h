// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "server/base/clock.h"
#include "server/store/postgres_hosts.h"

struct pg_conn;
struct pg_result;

namespace plumescout::server {

// A statement and the values of its parameters $1, $2 ... in order.
class PostgresStatement {
 public:
  explicit PostgresStatement(absl::string_view sql) : sql_(sql) {}

  PostgresStatement& Bind(std::int64_t value);
  PostgresStatement& BindText(absl::string_view text);
  PostgresStatement& BindBytes(absl::string_view bytes);
  PostgresStatement& BindNumbers(std::span<const std::int64_t> values);
  PostgresStatement& BindAllBytes(std::span<const std::string> values);
  // For a statement of few different texts that runs all the time: the database keeps it, parsed
  // and planned, for as long as the connection lasts.
  PostgresStatement& Keep();

 private:
  friend class PostgresConnection;

  PostgresStatement& Add(std::uint32_t type, std::string value);

  std::string sql_;
  std::vector<std::uint32_t> types_;
  std::vector<std::string> values_;  // as the wire has them
  bool is_kept_ = false;
};

// The rows that a statement gave.
class PostgresRows {
 public:
  explicit PostgresRows(pg_result* result) : result_(result) {}
  ~PostgresRows();
  PostgresRows(PostgresRows&& other) noexcept : result_(other.result_) { other.result_ = nullptr; }
  PostgresRows& operator=(PostgresRows&&) = delete;

  int count() const;
  bool is_null(int row, int column) const;
  // Of a whole number or a truth; 0 of null.
  std::int64_t Int(int row, int column) const;
  // Of text or bytes; empty of null.
  std::string Bytes(int row, int column) const;

 private:
  pg_result* result_;
};

// A connection to a database in PostgreSQL. Single-threaded. Every wait has an end.
//
// Errors name host and database, never what else an URL holds. kUnavailable (STORE_UNAVAILABLE):
// the database is away, full, read-only or slow, worth another try on a new connection; whether it
// did what it was asked to is uncertain. kDataLoss (STORE_DAMAGED): it says so itself, or lacks a
// table. kPermissionDenied, kFailedPrecondition: it does not let this user in, or there is none.
// kInternal: others, which do not go away by themselves. After an error it is of no use any more.
class PostgresConnection {
 public:
  // Of several hosts in the URL each gets an equal share of the time that is left, so that one that
  // is dark does not keep from the next.
  static absl::StatusOr<std::unique_ptr<PostgresConnection>> Open(const std::string& url,
                                                                  absl::Duration timeout);
  ~PostgresConnection();
  PostgresConnection(const PostgresConnection&) = delete;
  PostgresConnection& operator=(const PostgresConnection&) = delete;

  // "host:port/database"
  const std::string& name() const { return name_; }
  bool is_broken() const { return is_broken_; }

  // In one round trip, and in one transaction unless they begin and end another: all or nothing.
  absl::StatusOr<std::vector<PostgresRows>> RunAll(std::span<const PostgresStatement> statements,
                                                   absl::Duration timeout);
  absl::StatusOr<PostgresRows> Run(const PostgresStatement& statement, absl::Duration timeout);

 private:
  PostgresConnection(pg_conn* connection, std::string name);

  static absl::StatusOr<std::unique_ptr<PostgresConnection>> OpenAt(const std::string& url,
                                                                    const PostgresHost& host,
                                                                    absl::Duration timeout);
  absl::Status FinishOpening(SteadyTime limit);
  absl::Status Send(const PostgresStatement& statement);
  // Names the statements to the database that it is to keep and does not know yet. Returns how
  // many.
  absl::StatusOr<int> Prepare(std::span<const PostgresStatement> statements);
  absl::Status Flush(SteadyTime limit);
  // Without what was prepared, which is answered first.
  absl::StatusOr<std::vector<PostgresRows>> Collect(int prepared, SteadyTime limit);
  // Null: the end of a statement's results.
  absl::StatusOr<pg_result*> NextResult(SteadyTime limit);
  absl::Status Await(bool to_write, SteadyTime limit);
  absl::Status LinkError();
  absl::Status ResultError(const pg_result* result);

  pg_conn* const connection_;
  const std::string name_;
  bool is_broken_ = false;
  std::map<std::string, std::string> kept_;  // names by texts
};

// "host:port/database" of an URL, for messages; never a user or a password. kInvalidArgument.
absl::StatusOr<std::string> PostgresName(const std::string& url);

}  // namespace plumescout::server
