// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "server/store/database.h"

namespace plumescout::server {

// The format of the database: its version stands in user_version, and application_id says whose it
// is. A program of this version opens those of earlier ones and brings them up to date.
inline constexpr int kStoreFormat = 1;
inline constexpr int kStoreApplicationId = 0x506C5374;  // "PlSt"

// Makes an empty database under a name of its own, then moves it there: whatever happens in
// between, nobody meets half of one.
absl::Status MakeDatabase(const std::string& path);

// Whether it is a store and of a known format, as far as the file itself says. Changes nothing.
//
// Errors: kFailedPrecondition, naming the file, if it is another program's or of a newer format;
// kDataLoss if it is too short for a database; kUnavailable, kPermissionDenied.
absl::Status CheckDatabaseFile(const std::string& path);

// Brings a database of an earlier format up to date. kDataLoss if it does not hold the tables that
// it should.
absl::Status UpdateSchema(Database& database);
// Likewise, without changing anything.
absl::Status CheckSchema(Database& database);

}  // namespace plumescout::server
