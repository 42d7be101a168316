// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "server/config/config.h"

namespace plumescout::server {

// One option of the server: its key in the file, its place in the struct, its range.
struct ConfigRow {
  absl::string_view key;  // "limits.max_missions"
  absl::string_view help;
  std::variant<std::string*, int*, std::int64_t*, double*> target;
  double low = 0.0;  // of numbers
  double high = 0.0;
};

// Every option but those below `mission`, which are the fields of v1::MissionOptions.
std::vector<ConfigRow> ConfigTable(ServerConfig& config);

// Sets the row's option. kInvalidArgument "<key> = <text> must be ..." unless `text` is a number in
// the row's range.
absl::Status SetRow(const ConfigRow& row, const std::string& text);
std::string RowText(const ConfigRow& row);

}  // namespace plumescout::server
