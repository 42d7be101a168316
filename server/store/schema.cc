// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/schema.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <set>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/store_errors.h"
#include "server/store/store_folder.h"

namespace plumescout::server {
namespace {

// As sqlite_schema tells them again. Records lie in the order in which they came, which is that of
// writing; the index finds those of a mission. What changes with every commit (progress) lies apart
// from what may be large. No id of a mission is given out twice, so that whoever still reads a
// mission that was removed meets no other.
constexpr const char* kTables[] = {
    "CREATE TABLE mission(id INTEGER PRIMARY KEY AUTOINCREMENT, key TEXT NOT NULL UNIQUE, "
    "header BLOB NOT NULL, crc INTEGER NOT NULL)",
    "CREATE TABLE progress(mission INTEGER PRIMARY KEY, epoch INTEGER NOT NULL, "
    "head INTEGER NOT NULL, chain INTEGER NOT NULL, base INTEGER NOT NULL, "
    "base_chain INTEGER NOT NULL, bytes INTEGER NOT NULL, standing_crc INTEGER NOT NULL, "
    "writes INTEGER NOT NULL, crc INTEGER NOT NULL)",
    "CREATE TABLE standing(mission INTEGER PRIMARY KEY, bytes BLOB NOT NULL)",
    "CREATE TABLE record(id INTEGER PRIMARY KEY, mission INTEGER NOT NULL, "
    "number INTEGER NOT NULL, crc INTEGER NOT NULL, bytes BLOB NOT NULL, UNIQUE(mission, number))",
    "CREATE TABLE snapshot(id INTEGER PRIMARY KEY, mission INTEGER NOT NULL, "
    "revision INTEGER NOT NULL, digest INTEGER NOT NULL, crc INTEGER NOT NULL, "
    "bytes BLOB NOT NULL, UNIQUE(mission, revision))",
    "CREATE TABLE removed(mission INTEGER PRIMARY KEY)",
    "CREATE TABLE probe(id INTEGER PRIMARY KEY, count INTEGER NOT NULL)",
};

// kUpdates[n - 1] makes format n + 1 of format n.
constexpr std::array<const char*, kStoreFormat - 1> kUpdates = {};

constexpr std::size_t kHeaderBytes = 100;
constexpr std::size_t kUserVersionAt = 60;
constexpr std::size_t kApplicationIdAt = 68;
constexpr absl::string_view kMagic("SQLite format 3\0", 16);

std::uint32_t BigEndianAt(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < sizeof(value); ++i) {
    value = (value << 8) | static_cast<std::uint8_t>(bytes[at + i]);
  }
  return value;
}

absl::StatusOr<std::string> ReadHeader(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int open_error = errno;
  if (descriptor < 0) {
    const std::string what = absl::StrCat("cannot open ", path, ": ", strerror(open_error));
    if (open_error == EACCES) return absl::PermissionDeniedError(what);
    return StoreUnavailable(what);
  }
  std::string bytes(kHeaderBytes, '\0');
  const ssize_t size = pread(descriptor, bytes.data(), bytes.size(), 0);
  const int read_error = errno;
  close(descriptor);
  if (size < 0) return StoreUnavailable(absl::StrCat(path, ": ", strerror(read_error)));
  bytes.resize(static_cast<std::size_t>(size));
  return bytes;
}

absl::Status NotOurs(const std::string& path, absl::string_view why) {
  return absl::FailedPreconditionError(absl::StrCat(path, " is no store of PlumeScout: ", why));
}

absl::Status CheckFormat(const std::string& path, std::int64_t format) {
  if (format >= 1 && format <= kStoreFormat) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat(path, " has format ", format, "; this program knows 1 to ", kStoreFormat));
}

absl::Status CreateTables(Database& database) {
  Transaction transaction(&database);
  PLUMESCOUT_RETURN_IF_ERROR(transaction.Begin());
  for (const char* table : kTables) PLUMESCOUT_RETURN_IF_ERROR(database.Execute(table));
  PLUMESCOUT_RETURN_IF_ERROR(database.Execute(
      absl::StrCat("INSERT INTO probe VALUES(1, 0); PRAGMA application_id = ", kStoreApplicationId,
                   "; PRAGMA user_version = ", kStoreFormat)));
  return transaction.Commit();
}

absl::Status CheckTables(Database& database) {
  std::set<std::string> expected(std::begin(kTables), std::end(kTables));
  Query tables = database.Use("SELECT sql FROM sqlite_schema WHERE sql IS NOT NULL");
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool has_row, tables.Next());
    if (!has_row) break;
    const std::string sql = tables.Bytes(0);
    if (expected.erase(sql) > 0 || absl::StartsWith(sql, "CREATE TABLE sqlite_")) continue;
    return StoreDamaged(absl::StrCat(database.path(), ": unexpected ", sql));
  }
  if (expected.empty()) return absl::OkStatus();
  return StoreDamaged(absl::StrCat(database.path(), ": missing ", *expected.begin()));
}

}  // namespace

absl::Status MakeDatabase(const std::string& path) {
  const std::string made = path + ".new";
  for (const char* suffix : {"", "-journal", "-wal", "-shm"}) unlink((made + suffix).c_str());
  {
    PLUMESCOUT_ASSIGN_OR_RETURN(const auto database, Database::Open(made, Database::Access::kMake));
    PLUMESCOUT_RETURN_IF_ERROR(
        database->Execute("PRAGMA page_size = 16384; PRAGMA auto_vacuum = INCREMENTAL"));
    PLUMESCOUT_RETURN_IF_ERROR(CreateTables(*database));
  }
  if (rename(made.c_str(), path.c_str()) != 0) {
    return StoreUnavailable(absl::StrCat("cannot make ", path, ": ", strerror(errno)));
  }
  return SyncFolder(path.substr(0, path.rfind('/')));
}

absl::Status CheckDatabaseFile(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string header, ReadHeader(path));
  const bool is_sqlite = absl::StartsWith(header, kMagic);
  if (!header.empty() && !is_sqlite) return NotOurs(path, "not SQLite's");
  if (header.size() < kHeaderBytes) return StoreDamaged(absl::StrCat(path, " is cut off"));
  const std::uint32_t id = BigEndianAt(header, kApplicationIdAt);
  if (id != kStoreApplicationId) {
    return NotOurs(path, absl::StrCat("application_id is ", id, ", not ", kStoreApplicationId));
  }
  return CheckFormat(path, BigEndianAt(header, kUserVersionAt));
}

absl::Status UpdateSchema(Database& database) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t found, database.GetInt("PRAGMA user_version"));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFormat(database.path(), found));
  for (std::int64_t format = found; format < kStoreFormat; ++format) {
    Transaction transaction(&database);
    PLUMESCOUT_RETURN_IF_ERROR(transaction.Begin());
    PLUMESCOUT_RETURN_IF_ERROR(
        database.Execute(absl::StrCat(kUpdates.at(static_cast<std::size_t>(format - 1)),
                                      "; PRAGMA user_version = ", format + 1)));
    PLUMESCOUT_RETURN_IF_ERROR(transaction.Commit());
  }
  return CheckTables(database);
}

absl::Status CheckSchema(Database& database) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t found, database.GetInt("PRAGMA user_version"));
  PLUMESCOUT_RETURN_IF_ERROR(CheckFormat(database.path(), found));
  return found == kStoreFormat ? CheckTables(database) : absl::OkStatus();
}

}  // namespace plumescout::server
