// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/server/captured_log.h"

namespace plumescout::server {
namespace log_test {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

std::string Format(LogFormat format, const std::vector<LogField>& fields) {
  return FormatLogLine(format, absl::UnixEpoch(), LogLevel::kWarning, "odd", fields);
}

TEST(LogTest, LineHasTimeLevelWordsAndFacts) {
  const std::string log = LogOf([] {
    LogInfo("mission created", {{"mission", "hall"}, {"cells", "42"}});
  });
  EXPECT_THAT(log, MatchesRegex("[0-9-]+T[0-9:]+\\.[0-9]+Z INFO mission created mission=hall "
                                "cells=42\n"));
}

TEST(LogTest, ValueCannotForgeALine) {
  const std::string log = LogOf([] { LogWarning("odd", {{"name", "a\n2026 INFO b"}}); });
  EXPECT_THAT(log, MatchesRegex(".*Z WARNING odd name=\"a\\\\n2026 INFO b\"\n"));
}

TEST(LogTest, ValueCannotSteerATerminal) {
  EXPECT_EQ(Format(LogFormat::kText, {{"name", "\x1b[2J\xc2\x9b"}}),
            "1970-01-01T00:00:00.000Z WARNING odd name=\"\\x1b[2J\\xc2\\x9b\"\n");
  EXPECT_THAT(Format(LogFormat::kJson, {{"name", "\x1b[2J\xc2\x9b"}}),
              HasSubstr(R"("name":"\u001b[2J\u009b")"));
}

TEST(LogTest, JsonLineHoldsWhatTheTextDoes) {
  const std::string line =
      Format(LogFormat::kJson, {{"mission", "hall"}, {"why", "\"a\"\n\\b"}, {"empty", ""}});
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const auto json = nlohmann::json::parse(line);
  EXPECT_EQ(json, (nlohmann::json{{"time", "1970-01-01T00:00:00.000Z"},
                                  {"level", "WARNING"},
                                  {"event", "odd"},
                                  {"mission", "hall"},
                                  {"why", "\"a\"\n\\b"},
                                  {"empty", ""}}));
}

TEST(LogTest, BytesThatAreNoTextStayParsable) {
  const std::string line = Format(LogFormat::kJson, {{"name", "a\xff\xc3(\n"}});
  EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  EXPECT_EQ(line.find('\n'), line.size() - 1);
}

TEST(LogTest, LongValuesAreCut) {
  for (const LogFormat format : {LogFormat::kText, LogFormat::kJson}) {
    const std::string line = Format(format, {{"name", std::string(100'000, '\n')}});
    EXPECT_LT(line.size(), 2'000u);
    EXPECT_THAT(line, HasSubstr("...\""));
  }
}

TEST(LogTest, LowerLevelsAreLeftOut) {
  const std::string log = LogOf([] {
    LogDebug("one");
    ConfigureLog({LogLevel::kWarning, LogFormat::kJson});
    LogInfo("two");
    LogWarning("three");
    LogError("four");
    ConfigureLog({LogLevel::kDebug, LogFormat::kText});
    LogDebug("five");
    ConfigureLog({});
  });
  EXPECT_THAT(log,
              MatchesRegex("\\{.*WARNING.*three.*\\}\n\\{.*ERROR.*four.*\\}\n.*Z DEBUG five\n"));
}

TEST(LogTest, WrittenLinesAreCounted) {
  const std::int64_t before = LogLineCounts().written;
  LogOf([] { LogInfo("one"); });
  EXPECT_EQ(LogLineCounts().written, before + 1);
  EXPECT_EQ(LogLineCounts().dropped, 0);
}

TEST(LogTest, WordsOfConfigurations) {
  EXPECT_EQ(ParseLogLevel("warning"), LogLevel::kWarning);
  EXPECT_EQ(ParseLogLevel("WARNING"), std::nullopt);
  EXPECT_EQ(ParseLogFormat("json"), LogFormat::kJson);
  EXPECT_EQ(ParseLogFormat(""), std::nullopt);
}

}  // namespace log_test
}  // namespace plumescout::server
