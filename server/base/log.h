// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

#include "absl/strings/string_view.h"

namespace plumescout::server {

// A named fact of a log line.
struct LogField {
  absl::string_view name;
  std::string value;
};

// One line on stderr, written whole:
//   2026-01-02T03:04:05.678Z INFO mission created mission=demo cells=4000000
void LogInfo(absl::string_view what, std::initializer_list<LogField> fields = {});
void LogWarning(absl::string_view what, std::initializer_list<LogField> fields = {});

}  // namespace plumescout::server
