// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

namespace plumescout::server {
namespace {

ConfigRow Find(ServerConfig& config, absl::string_view key) {
  for (const ConfigRow& row : ConfigTable(config)) {
    if (row.key == key) return row;
  }
  ADD_FAILURE() << key;
  return {};
}

TEST(ConfigTableTest, KeysAreUniqueAndDefaultsLieInTheirRanges) {
  ServerConfig config;
  std::set<std::string> keys;
  for (const ConfigRow& row : ConfigTable(config)) {
    EXPECT_TRUE(keys.insert(std::string(row.key)).second) << row.key;
    EXPECT_FALSE(row.help.empty()) << row.key;
    EXPECT_TRUE(SetRow(row, RowText(row)).ok()) << row.key;
  }
}

TEST(ConfigTableTest, EachKindOfOptionIsSet) {
  ServerConfig config;
  EXPECT_TRUE(SetRow(Find(config, "listen"), "[::]:1").ok());
  EXPECT_TRUE(SetRow(Find(config, "planning.threads"), "3").ok());
  EXPECT_TRUE(SetRow(Find(config, "limits.max_total_cells"), "5000000000").ok());
  EXPECT_TRUE(SetRow(Find(config, "connection.lease_hold_s"), "2.5").ok());
  EXPECT_EQ(config.listen, "[::]:1");
  EXPECT_EQ(config.planning.threads, 3);
  EXPECT_EQ(config.limits.max_total_cells, 5'000'000'000);
  EXPECT_EQ(config.connection.lease_hold_s, 2.5);
}

TEST(ConfigTableTest, WhatIsNoNumberInRangeIsRefusedAndChangesNothing) {
  ServerConfig config;
  const ConfigRow row = Find(config, "planning.threads");
  for (const char* text : {"", "many", "0", "-1", "1e9", "2.5", "99999999999", "nan"}) {
    EXPECT_TRUE(absl::IsInvalidArgument(SetRow(row, text))) << text;
  }
  EXPECT_TRUE(absl::IsInvalidArgument(SetRow(Find(config, "connection.drain_s"), "nan")));
  EXPECT_EQ(config.planning.threads, ServerConfig().planning.threads);
  EXPECT_EQ(SetRow(row, "0").message(), "planning.threads = 0 must be a number in [1, 256]");
}

}  // namespace
}  // namespace plumescout::server
