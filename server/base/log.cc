// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/log.h"

#include <cstdio>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"

namespace plumescout::server {
namespace {

// Values with spaces or unprintable bytes are quoted, so that a line stays one line of words.
std::string Quoted(const std::string& value) {
  const std::string escaped = absl::CHexEscape(value);
  const bool plain = escaped == value && value.find(' ') == std::string::npos;
  return plain ? value : absl::StrCat("\"", escaped, "\"");
}

void Log(absl::string_view level, absl::string_view what, std::initializer_list<LogField> fields) {
  std::string line =
      absl::StrCat(absl::FormatTime("%Y-%m-%dT%H:%M:%E3SZ", absl::Now(), absl::UTCTimeZone()), " ",
                   level, " ", what);
  for (const LogField& field : fields) {
    absl::StrAppend(&line, " ", field.name, "=", Quoted(field.value));
  }
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

void LogInfo(absl::string_view what, std::initializer_list<LogField> fields) {
  Log("INFO", what, fields);
}

void LogWarning(absl::string_view what, std::initializer_list<LogField> fields) {
  Log("WARNING", what, fields);
}

}  // namespace plumescout::server
