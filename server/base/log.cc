// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/log.h"

#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"

namespace plumescout::server {
namespace {

constexpr std::size_t kMaxQueuedBytes = 1 << 20;
constexpr std::size_t kMaxValueBytes = 512;

std::atomic<LogLevel> lowest_level = LogLevel::kInfo;
std::atomic<LogFormat> line_format = LogFormat::kText;

absl::string_view LevelName(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return "DEBUG";
    case LogLevel::kInfo:
      return "INFO";
    case LogLevel::kWarning:
      return "WARNING";
    case LogLevel::kError:
      return "ERROR";
  }
  return "";
}

std::string Cut(const std::string& value) {
  if (value.size() <= kMaxValueBytes) return value;
  return absl::StrCat(value.substr(0, kMaxValueBytes), "...");
}

// Values with spaces or unprintable bytes are quoted, so that a line stays one line of words.
std::string Quoted(const std::string& value) {
  const std::string escaped = absl::CHexEscape(value);
  const bool plain = escaped == value && !value.empty() && value.find(' ') == std::string::npos;
  return plain ? value : absl::StrCat("\"", escaped, "\"");
}

std::string TextLine(absl::string_view time, LogLevel level, absl::string_view what,
                     const std::vector<LogField>& fields) {
  std::string line = absl::StrCat(time, " ", LevelName(level), " ", what);
  for (const LogField& field : fields) {
    absl::StrAppend(&line, " ", field.name, "=", Quoted(Cut(field.value)));
  }
  return line + "\n";
}

std::string JsonLine(absl::string_view time, LogLevel level, absl::string_view what,
                     const std::vector<LogField>& fields) {
  nlohmann::ordered_json line;
  line["time"] = std::string(time);
  line["level"] = std::string(LevelName(level));
  line["event"] = std::string(what);
  for (const LogField& field : fields) line[std::string(field.name)] = Cut(field.value);
  constexpr int kOneLine = -1;
  constexpr bool kAsciiOnly = true;
  return line.dump(kOneLine, ' ', kAsciiOnly, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string LineNow(LogLevel level, absl::string_view what, const std::vector<LogField>& fields) {
  return FormatLogLine(line_format, absl::Now(), level, what, fields);
}

// Never destroyed: threads may log until the process is gone.
LineWriter& Lines() {
  static auto& lines = *new LineWriter(STDERR_FILENO, kMaxQueuedBytes, [](std::int64_t dropped) {
    return LineNow(LogLevel::kWarning, "log lines dropped", {{"lines", absl::StrCat(dropped)}});
  });
  return lines;
}

}  // namespace

std::optional<LogLevel> ParseLogLevel(absl::string_view word) {
  if (word == "debug") return LogLevel::kDebug;
  if (word == "info") return LogLevel::kInfo;
  if (word == "warning") return LogLevel::kWarning;
  if (word == "error") return LogLevel::kError;
  return std::nullopt;
}

std::optional<LogFormat> ParseLogFormat(absl::string_view word) {
  if (word == "text") return LogFormat::kText;
  if (word == "json") return LogFormat::kJson;
  return std::nullopt;
}

std::string FormatLogLine(LogFormat format, absl::Time time, LogLevel level, absl::string_view what,
                          const std::vector<LogField>& fields) {
  const std::string when = absl::FormatTime("%Y-%m-%dT%H:%M:%E3SZ", time, absl::UTCTimeZone());
  return format == LogFormat::kJson ? JsonLine(when, level, what, fields)
                                    : TextLine(when, level, what, fields);
}

void Log(LogLevel level, absl::string_view what, const std::vector<LogField>& fields) {
  if (IsLogged(level)) Lines().Push(LineNow(level, what, fields));
}

void LogDebug(absl::string_view what, std::initializer_list<LogField> fields) {
  Log(LogLevel::kDebug, what, fields);
}

void LogInfo(absl::string_view what, std::initializer_list<LogField> fields) {
  Log(LogLevel::kInfo, what, fields);
}

void LogWarning(absl::string_view what, std::initializer_list<LogField> fields) {
  Log(LogLevel::kWarning, what, fields);
}

void LogError(absl::string_view what, std::initializer_list<LogField> fields) {
  Log(LogLevel::kError, what, fields);
}

void ConfigureLog(const LogOptions& options) {
  lowest_level = options.level;
  line_format = options.format;
}

bool IsLogged(LogLevel level) { return level >= lowest_level.load(); }

bool FlushLog(absl::Duration patience) { return Lines().Flush(patience); }

LineCounts LogLineCounts() { return Lines().counts(); }

}  // namespace plumescout::server
