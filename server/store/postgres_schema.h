// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/postgres_connection.h"

namespace plumescout::server {

// The format of the tables; it stands in plumescout_store.
inline constexpr std::int64_t kSharedStoreFormat = 1;

// Makes the tables, for this cluster, unless they stand, and checks them. Servers may do it at the
// same time. What tells this store from all others, for CheckSameStore.
//
// Errors, naming the database; nothing was written then: kFailedPrecondition if it is of another
// format, of another cluster, or read-only; kDataLoss if a table is not as it should be; those of
// PostgresConnection.
absl::StatusOr<std::int64_t> OpenSharedSchema(PostgresConnection& connection,
                                              const std::string& cluster);

// Whether behind the address there is still the store that was opened. kUnavailable if it is
// another, or read-only.
absl::Status CheckSameStore(PostgresConnection& connection, std::int64_t store,
                            absl::Duration timeout = absl::Seconds(5));

}  // namespace plumescout::server
