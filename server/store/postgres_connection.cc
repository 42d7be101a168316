// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_connection.h"

#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

#include "absl/memory/memory.h"
#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "core/types/status_macros.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

// Of types in PostgreSQL, the same in every database.
constexpr std::uint32_t kBytesType = 17;
constexpr std::uint32_t kNumberType = 20;
constexpr std::uint32_t kTextType = 25;
constexpr std::uint32_t kBytesArrayType = 1001;
constexpr std::uint32_t kNumberArrayType = 1016;

constexpr int kBinary = 1;

std::string BigEndian(std::uint64_t value, std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) {
    bytes[size - 1 - i] = static_cast<char>(value >> (8 * i) & 0xFF);
  }
  return bytes;
}

// What an array begins with: dimensions, nulls, type, and count and first index of the dimension.
std::string ArrayHead(std::uint32_t type, std::size_t count) {
  return absl::StrCat(BigEndian(count > 0 ? 1 : 0, 4), BigEndian(0, 4), BigEndian(type, 4),
                      count > 0 ? BigEndian(count, 4) + BigEndian(1, 4) : "");
}

std::string Trimmed(const char* message) {
  return absl::StrReplaceAll(absl::StripAsciiWhitespace(message), {{"\n", "; "}, {"\t", ""}});
}

// Classes and codes of SQLSTATE that another try may be without.
bool MayPass(absl::string_view state) {
  for (const char* prefix : {"08", "40", "53", "57", "58", "25006", "55P03", "55006"}) {
    if (absl::StartsWith(state, prefix)) return true;
  }
  return state.empty();  // the link broke
}

absl::Status ErrorOf(absl::string_view state, const std::string& message) {
  if (MayPass(state)) return StoreUnavailable(message);
  if (absl::StartsWith(state, "28") || state == "42501") {
    return absl::PermissionDeniedError(message);
  }
  if (state == "3D000") return absl::FailedPreconditionError(message);
  const bool is_damage = absl::StartsWith(state, "XX") || state == "42P01" || state == "42703";
  if (is_damage) return StoreDamaged(message);
  if (absl::StartsWith(state, "54")) return absl::ResourceExhaustedError(message);
  return absl::InternalError(message);
}

// A machine that turns dark under an open connection is noticed in some ten seconds, unless the URL
// says otherwise.
PGconn* StartLink(const std::string& url, const PostgresHost& host) {
  std::vector<const char*> keywords = {"tcp_user_timeout", "keepalives_idle", "keepalives_interval",
                                       "keepalives_count", "dbname"};
  std::vector<const char*> values = {"10000", "5", "2", "3", url.c_str()};
  const auto choose = [&](const char* keyword, const std::string& value) {
    if (value.empty()) return;
    keywords.push_back(keyword);
    values.push_back(value.c_str());
  };
  choose("host", host.host);
  choose("hostaddr", host.address);
  choose("port", host.port);
  keywords.push_back(nullptr);
  values.push_back(nullptr);
  return PQconnectStartParams(keywords.data(), values.data(), /*expand_dbname=*/1);
}

}  // namespace

PostgresStatement& PostgresStatement::Add(std::uint32_t type, std::string value) {
  types_.push_back(type);
  values_.push_back(std::move(value));
  return *this;
}

PostgresStatement& PostgresStatement::Bind(std::int64_t value) {
  return Add(kNumberType, BigEndian(static_cast<std::uint64_t>(value), 8));
}

PostgresStatement& PostgresStatement::BindText(absl::string_view text) {
  return Add(kTextType, std::string(text));
}

PostgresStatement& PostgresStatement::BindBytes(absl::string_view bytes) {
  return Add(kBytesType, std::string(bytes));
}

PostgresStatement& PostgresStatement::BindNumbers(std::span<const std::int64_t> values) {
  std::string array = ArrayHead(kNumberType, values.size());
  for (const std::int64_t value : values) {
    absl::StrAppend(&array, BigEndian(8, 4), BigEndian(static_cast<std::uint64_t>(value), 8));
  }
  return Add(kNumberArrayType, std::move(array));
}

PostgresStatement& PostgresStatement::BindAllBytes(std::span<const std::string> values) {
  std::string array = ArrayHead(kBytesType, values.size());
  for (const std::string& value : values) {
    absl::StrAppend(&array, BigEndian(value.size(), 4), value);
  }
  return Add(kBytesArrayType, std::move(array));
}

PostgresStatement& PostgresStatement::Keep() {
  is_kept_ = true;
  return *this;
}

PostgresRows::~PostgresRows() { PQclear(result_); }

int PostgresRows::count() const { return PQntuples(result_); }

bool PostgresRows::is_null(int row, int column) const {
  return PQgetisnull(result_, row, column) != 0;
}

std::int64_t PostgresRows::Int(int row, int column) const {
  if (is_null(row, column)) return 0;
  const char* const bytes = PQgetvalue(result_, row, column);
  const int size = PQgetlength(result_, row, column);
  // The first byte has the sign.
  std::uint64_t value = size > 0 && (bytes[0] & 0x80) != 0 ? ~std::uint64_t{0} : 0;
  for (int i = 0; i < size; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return static_cast<std::int64_t>(value);
}

std::string PostgresRows::Bytes(int row, int column) const {
  return {PQgetvalue(result_, row, column),
          static_cast<std::size_t>(PQgetlength(result_, row, column))};
}

absl::StatusOr<std::string> PostgresName(const std::string& url) {
  char* message = nullptr;
  PQconninfoOption* const options = PQconninfoParse(url.c_str(), &message);
  PQfreemem(message);  // it may repeat what it cannot read
  if (options == nullptr) {
    return absl::InvalidArgumentError("the URL of the database cannot be read");
  }
  std::string host = "local socket";
  std::string port;
  std::string database;
  for (const PQconninfoOption* option = options; option->keyword != nullptr; ++option) {
    if (option->val == nullptr) continue;
    const absl::string_view keyword = option->keyword;
    if (keyword == "host") host = option->val;
    if (keyword == "port") port = absl::StrCat(":", option->val);
    if (keyword == "dbname") database = absl::StrCat("/", option->val);
  }
  PQconninfoFree(options);
  return absl::StrCat(host, port, database);
}

PostgresConnection::PostgresConnection(pg_conn* connection, std::string name)
    : connection_(connection), name_(std::move(name)) {}

PostgresConnection::~PostgresConnection() { PQfinish(connection_); }

absl::StatusOr<std::unique_ptr<PostgresConnection>> PostgresConnection::Open(
    const std::string& url, absl::Duration timeout) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<PostgresHost> hosts, PostgresHosts(url));
  const SteadyTime limit = After(SteadyNow(), timeout);
  absl::Status error;
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    const absl::Duration left = absl::FromChrono(limit - SteadyNow());
    auto opened = OpenAt(url, hosts[i], left / static_cast<std::int64_t>(hosts.size() - i));
    if (!absl::IsUnavailable(opened.status())) return opened;
    error = error.ok()
                ? opened.status()
                : StoreUnavailable(absl::StrCat(error.message(), "; ", opened.status().message()));
  }
  return error;
}

absl::StatusOr<std::unique_ptr<PostgresConnection>> PostgresConnection::OpenAt(
    const std::string& url, const PostgresHost& host, absl::Duration timeout) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string name, PostgresName(url));
  const SteadyTime limit = After(SteadyNow(), timeout);
  PGconn* const link = StartLink(url, host);
  if (link == nullptr) return StoreUnavailable(absl::StrCat(name, ": no memory"));
  PQsetNoticeProcessor(
      link, [](void*, const char*) {}, nullptr);  // else it writes to stderr
  auto connection = absl::WrapUnique(new PostgresConnection(link, name));
  PLUMESCOUT_RETURN_IF_ERROR(connection->FinishOpening(limit));
  // Whatever the database is set to, a commit is one when it is on the disk, and what we have given
  // up the database gives up too.
  std::vector<PostgresStatement> settings;
  settings.emplace_back(
      "SELECT CASE WHEN current_setting('synchronous_commit') = 'off' "
      "THEN set_config('synchronous_commit', 'on', false) END");
  settings.emplace_back("SELECT set_config('statement_timeout', '60s', false)");
  settings.emplace_back("SELECT set_config('lock_timeout', '10s', false)");
  settings.emplace_back("SELECT set_config('client_encoding', 'UTF8', false)");
  // A machine that is gone in the middle of a commit frees its rows in some ten seconds.
  settings.emplace_back(
      "SELECT set_config('tcp_keepalives_idle', '5', false), "
      "set_config('tcp_keepalives_interval', '2', false), "
      "set_config('tcp_keepalives_count', '3', false)");
  PLUMESCOUT_RETURN_IF_ERROR(
      connection->RunAll(settings, absl::FromChrono(limit - SteadyNow())).status());
  return connection;
}

absl::Status PostgresConnection::FinishOpening(SteadyTime limit) {
  bool to_write = true;
  while (PQstatus(connection_) != CONNECTION_BAD) {
    PLUMESCOUT_RETURN_IF_ERROR(Await(to_write, limit));
    const PostgresPollingStatusType polled = PQconnectPoll(connection_);
    if (polled == PGRES_POLLING_OK) {
      const bool is_set =
          PQsetnonblocking(connection_, 1) == 0 && PQenterPipelineMode(connection_) == 1;
      return is_set ? absl::OkStatus() : LinkError();
    }
    if (polled == PGRES_POLLING_FAILED) break;
    to_write = polled == PGRES_POLLING_WRITING;
  }
  // libpq keeps no SQLSTATE of a refused connection, only its words.
  const std::string message = absl::StrCat(name_, ": ", Trimmed(PQerrorMessage(connection_)));
  for (const char* refused : {"authentication failed", "no pg_hba.conf entry", "does not exist",
                              "no password supplied", "is not permitted to log in"}) {
    const bool is_missing_socket = absl::StrContains(message, "No such file or directory");
    if (!is_missing_socket && absl::StrContains(message, refused)) {
      return absl::PermissionDeniedError(message);
    }
  }
  return StoreUnavailable(message);
}

absl::StatusOr<std::vector<PostgresRows>> PostgresConnection::RunAll(
    std::span<const PostgresStatement> statements, absl::Duration timeout) {
  if (is_broken_) return StoreUnavailable(absl::StrCat(name_, ": the connection is broken"));
  const SteadyTime limit = After(SteadyNow(), timeout);
  is_broken_ = true;  // unless all goes well
  PLUMESCOUT_ASSIGN_OR_RETURN(const int prepared, Prepare(statements));
  for (const PostgresStatement& statement : statements) {
    PLUMESCOUT_RETURN_IF_ERROR(Send(statement));
  }
  if (PQpipelineSync(connection_) != 1) return LinkError();
  PLUMESCOUT_RETURN_IF_ERROR(Flush(limit));
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<PostgresRows> rows, Collect(prepared, limit));
  if (rows.size() != statements.size()) {
    return StoreUnavailable(absl::StrCat(name_, ": ", rows.size(), " of ", statements.size(),
                                         " statements were answered"));
  }
  is_broken_ = false;
  return rows;
}

absl::StatusOr<PostgresRows> PostgresConnection::Run(const PostgresStatement& statement,
                                                     absl::Duration timeout) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<PostgresRows> rows,
                              RunAll(std::span(&statement, 1), timeout));
  return std::move(rows.front());
}

absl::StatusOr<int> PostgresConnection::Prepare(std::span<const PostgresStatement> statements) {
  int prepared = 0;
  for (const PostgresStatement& statement : statements) {
    if (!statement.is_kept_ || kept_.contains(statement.sql_)) continue;
    const std::string& name =
        kept_.emplace(statement.sql_, absl::StrCat("kept_", kept_.size())).first->second;
    const int sent =
        PQsendPrepare(connection_, name.c_str(), statement.sql_.c_str(),
                      static_cast<int>(statement.types_.size()), statement.types_.data());
    if (sent != 1) return LinkError();
    ++prepared;
  }
  return prepared;
}

absl::Status PostgresConnection::Send(const PostgresStatement& statement) {
  std::vector<const char*> values;
  std::vector<int> lengths;
  for (const std::string& value : statement.values_) {
    values.push_back(value.data());
    lengths.push_back(static_cast<int>(value.size()));
  }
  const std::vector<int> formats(values.size(), kBinary);
  const int count = static_cast<int>(values.size());
  const int sent =
      statement.is_kept_
          ? PQsendQueryPrepared(connection_, kept_.at(statement.sql_).c_str(), count, values.data(),
                                lengths.data(), formats.data(), kBinary)
          : PQsendQueryParams(connection_, statement.sql_.c_str(), count, statement.types_.data(),
                              values.data(), lengths.data(), formats.data(), kBinary);
  return sent == 1 ? absl::OkStatus() : LinkError();
}

absl::Status PostgresConnection::Flush(SteadyTime limit) {
  while (true) {
    const int left = PQflush(connection_);
    if (left == 0) return absl::OkStatus();
    if (left < 0) return LinkError();
    PLUMESCOUT_RETURN_IF_ERROR(Await(/*to_write=*/true, limit));
    // It answers the first statements while we send the last, and neither may wait for the other.
    if (PQconsumeInput(connection_) != 1) return LinkError();
  }
}

absl::StatusOr<std::vector<PostgresRows>> PostgresConnection::Collect(int prepared,
                                                                      SteadyTime limit) {
  std::vector<PostgresRows> rows;
  absl::Status error;
  bool was_end = false;
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(pg_result* const result, NextResult(limit));
    if (result == nullptr && was_end) return LinkError();  // nothing comes any more
    was_end = result == nullptr;
    if (was_end) continue;
    const ExecStatusType status = PQresultStatus(result);
    PostgresRows owned(result);
    if (status == PGRES_PIPELINE_SYNC) break;
    const bool is_done = status == PGRES_TUPLES_OK || status == PGRES_COMMAND_OK;
    if (is_done && prepared > 0) {
      --prepared;
    } else if (is_done) {
      rows.push_back(std::move(owned));
    } else if (error.ok()) {  // those that follow were left out
      error = ResultError(result);
      if (PQstatus(connection_) == CONNECTION_BAD) return error;
    }
  }
  PLUMESCOUT_RETURN_IF_ERROR(error);
  return rows;
}

absl::StatusOr<pg_result*> PostgresConnection::NextResult(SteadyTime limit) {
  while (PQisBusy(connection_) != 0) {
    PLUMESCOUT_RETURN_IF_ERROR(Await(/*to_write=*/false, limit));
    if (PQconsumeInput(connection_) != 1) return LinkError();
  }
  pg_result* const result = PQgetResult(connection_);
  if (result == nullptr && PQstatus(connection_) == CONNECTION_BAD) return LinkError();
  return result;
}

absl::Status PostgresConnection::Await(bool to_write, SteadyTime limit) {
  const short events = static_cast<short>(to_write ? POLLIN | POLLOUT : POLLIN);
  while (true) {
    const absl::Duration left = absl::FromChrono(limit - SteadyNow());
    if (left <= absl::ZeroDuration()) {
      return StoreUnavailable(absl::StrCat(name_, ": no answer in time"));
    }
    pollfd link = {PQsocket(connection_), events, 0};
    if (link.fd < 0) return LinkError();
    const std::int64_t left_ms =
        std::min<std::int64_t>(absl::ToInt64Milliseconds(left) + 1, 60'000);
    const int ready = poll(&link, 1, static_cast<int>(left_ms));
    if (ready > 0) return absl::OkStatus();
    if (ready < 0 && errno != EINTR) {
      return StoreUnavailable(absl::StrCat(name_, ": ", strerror(errno)));
    }
  }
}

absl::Status PostgresConnection::LinkError() {
  return StoreUnavailable(absl::StrCat(name_, ": ", Trimmed(PQerrorMessage(connection_))));
}

absl::Status PostgresConnection::ResultError(const pg_result* result) {
  const char* const state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  return ErrorOf(state == nullptr ? "" : state,
                 absl::StrCat(name_, ": ", Trimmed(PQresultErrorMessage(result))));
}

}  // namespace plumescout::server
