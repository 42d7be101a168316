// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace plumescout::server {

// Where a database may be: what stands at one place of the lists in an URL. Empty: libpq's choice.
struct PostgresHost {
  std::string host;
  std::string address;
  std::string port;

  friend bool operator==(const PostgresHost&, const PostgresHost&) = default;
};

// In the URL's order, one at least. kInvalidArgument, without what the URL holds.
absl::StatusOr<std::vector<PostgresHost>> PostgresHosts(const std::string& url);

}  // namespace plumescout::server
