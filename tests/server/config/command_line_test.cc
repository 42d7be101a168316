// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plumescout::server {
namespace command_line_test {

using ::testing::HasSubstr;
using ::testing::Not;

absl::StatusOr<CommandLine> Read(std::vector<const char*> flags) {
  flags.insert(flags.begin(), "plumescout-server");
  return ReadCommandLine(static_cast<int>(flags.size()), flags.data());
}

TEST(CommandLineTest, WithoutFlagsEverythingIsDefault) {
  const auto line = Read({});
  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_EQ(line->config.listen, "127.0.0.1:50551");
  EXPECT_FALSE(line->print.has_value());
}

TEST(CommandLineTest, FlagsWinOverTheFile) {
  const auto line = Read({"--config", "deploy/config/plumescout.yaml", "--listen", "127.0.0.1:0",
                          "--set", "limits.max_missions=3", "--set", "mission.seed=9"});
  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_EQ(line->config.listen, "127.0.0.1:0");
  EXPECT_EQ(line->config.limits.max_missions, 3);
  EXPECT_EQ(line->config.mission.seed, 9u);
}

TEST(CommandLineTest, LogFormatIsAFlag) {
  const auto line = Read({"--log-format", "json"});
  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_EQ(line->config.observe.log_format, "json");
  EXPECT_THAT(std::string(Read({"--log-format", "xml"}).status().message()),
              HasSubstr("must be one of text, json"));
}

TEST(CommandLineTest, MissionsAreKeptUnlessToldOtherwise) {
  EXPECT_EQ(Read({})->config.store.engine, kSqliteStore);
  EXPECT_EQ(Read({"--data", "d"})->config.store.folder, "d");
  EXPECT_EQ(Read({"--http", "127.0.0.1:8080"})->config.console.listen, "127.0.0.1:8080");
  EXPECT_EQ(Read({"--http-root", "d"})->config.console.folder, "d");
  EXPECT_EQ(Read({})->config.record.folder, "");
  EXPECT_EQ(Read({"--record", "d"})->config.record.folder, "d");
  EXPECT_EQ(Read({"--store", "none"})->config.store.engine, kNoStore);
  EXPECT_EQ(Read({"--set", "store.engine=none"})->config.store.engine, kNoStore);
  EXPECT_THAT(std::string(Read({"--store", "floppy"}).status().message()),
              HasSubstr("store.engine = floppy must be one of none, sqlite, postgresql"));
}

TEST(CommandLineTest, ASharedStoreIsAUrlAndTheNameOfANode) {
  const auto line = Read({"--store", "postgresql://scout@db:5432/plumes", "--node", "n1"});
  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_EQ(line->config.store.engine, kPostgresqlStore);
  EXPECT_EQ(line->config.store.url, "postgresql://scout@db:5432/plumes");
  EXPECT_EQ(line->config.store.node, "n1");
  EXPECT_EQ(line->config.store.lease_s, 10.0);
  EXPECT_THAT(std::string(Read({"--store", "postgresql://scout@db/plumes"}).status().message()),
              HasSubstr("store.node =  must be a word"));
  const std::string slip(
      Read({"--store", "postgresql:/scout:secret@db/plumes", "--node", "n1"}).status().message());
  EXPECT_THAT(slip, HasSubstr("store.url must be postgresql://user@host:port/database"));
  EXPECT_THAT(slip, Not(HasSubstr("secret")));
}

TEST(CommandLineTest, HelpNamesFlagsAndOptions) {
  const auto line = Read({"--help"});
  ASSERT_TRUE(line.ok() && line->print.has_value());
  EXPECT_THAT(*line->print, HasSubstr("--listen"));
  EXPECT_THAT(*line->print, HasSubstr("limits.max_missions = 8"));
  EXPECT_THAT(*line->print, HasSubstr("store.engine = sqlite"));
  EXPECT_THAT(*line->print, HasSubstr("mission.planning.speed_mps = 1.25"));
}

TEST(CommandLineTest, MistakesAreNamed) {
  EXPECT_THAT(std::string(Read({"--lissen", "x"}).status().message()), HasSubstr("--lissen"));
  EXPECT_THAT(std::string(Read({"--set", "x"}).status().message()), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(std::string(Read({"--set", "x=1"}).status().message()),
              HasSubstr("x is not an option"));
  EXPECT_FALSE(Read({"--config", "/no/such/file"}).ok());
}

}  // namespace command_line_test
}  // namespace plumescout::server
