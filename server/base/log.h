// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "server/base/line_writer.h"

namespace plumescout::server {

enum class LogLevel { kDebug, kInfo, kWarning, kError };
enum class LogFormat { kText, kJson };

struct LogOptions {
  LogLevel level = LogLevel::kInfo;  // lines of lower levels are left out
  LogFormat format = LogFormat::kText;
};

// As configurations write them, "warning" and "json"; nothing for any other word.
std::optional<LogLevel> ParseLogLevel(absl::string_view word);
std::optional<LogFormat> ParseLogFormat(absl::string_view word);

// A named fact of a log line.
struct LogField {
  absl::string_view name;
  std::string value;
};

// One line on stderr:
//   2026-01-02T03:04:05.678Z INFO mission created mission=demo cells=4000000
//   {"time":"2026-01-02T03:04:05.678Z","level":"INFO","event":"mission created","mission":"demo"}
// Whatever the values hold, a line stays one line, and long values are cut. The caller never waits
// for who reads stderr, see LineWriter.
void Log(LogLevel level, absl::string_view what, const std::vector<LogField>& fields);
void LogDebug(absl::string_view what, std::initializer_list<LogField> fields = {});
void LogInfo(absl::string_view what, std::initializer_list<LogField> fields = {});
void LogWarning(absl::string_view what, std::initializer_list<LogField> fields = {});
void LogError(absl::string_view what, std::initializer_list<LogField> fields = {});

// Of all lines from now on.
void ConfigureLog(const LogOptions& options);
bool IsLogged(LogLevel level);

// Waits until what was logged is on stderr, but no longer than this. False if it is not.
bool FlushLog(absl::Duration patience);
LineCounts LogLineCounts();

// The line of these facts, with its '\n'.
std::string FormatLogLine(LogFormat format, absl::Time time, LogLevel level, absl::string_view what,
                          const std::vector<LogField>& fields);

}  // namespace plumescout::server
