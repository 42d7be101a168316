// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/registry_options.h"

#include <gtest/gtest.h>

namespace plumescout::server {
namespace registry_options_test {

TEST(RegistryOptionsTest, MissionsAreAsTheConfigurationSays) {
  ServerConfig config;
  config.limits.max_missions = 3;
  config.limits.max_wait_s = 5.0;
  config.store.max_backlog_bytes = 70'000;
  config.store.sleep_after_s = 60.0;
  const RegistryOptions options = ToRegistryOptions(config, 17);
  EXPECT_EQ(options.max_missions, 3);
  EXPECT_EQ(options.host.max_wait, absl::Seconds(5));
  EXPECT_EQ(options.host.first_lease_token, 17);
  EXPECT_EQ(options.max_backlog_bytes, 70'000);
  EXPECT_EQ(options.sleep_after, absl::Seconds(60));
  config.store.sleep_after_s = 0.0;
  EXPECT_EQ(ToRegistryOptions(config, 17).sleep_after, absl::InfiniteDuration());
}

TEST(RegistryOptionsTest, ImportsGoWhereThereIsRoom) {
  ServerConfig config;
  config.limits.max_import_bytes = 5'000'000;
  config.store.folder = "/srv/missions";
  EXPECT_EQ(ToImportLimits(config).max_bytes, 5'000'000);
  EXPECT_EQ(ToImportLimits(config).folder, "") << "nothing is kept in a folder";
  config.store.engine = kSqliteStore;
  EXPECT_EQ(ToImportLimits(config).folder, "/srv/missions");
}

TEST(RegistryOptionsTest, RecordingsAreAsTheConfigurationSays) {
  const RecordingOptions options = ToRecordingOptions({"d", 2.0, 0.5, 3.0, 4'000'000});
  EXPECT_EQ(options.folder, "d");
  EXPECT_EQ(options.map_period_s, 2.0);
  EXPECT_EQ(options.map_share, 0.5);
  EXPECT_EQ(ToRecordingOptions({}).map_share, RecordingOptions().map_share);
  EXPECT_EQ(options.file.chunk_period, absl::Seconds(3));
  EXPECT_EQ(options.file.max_file_bytes, 4'000'000);
}

TEST(RegistryOptionsTest, NoViewerHasTheQueueToItself) {
  MapConfig config;
  config.max_queued_queries = 9;
  const FairPoolOptions options = ToViewersPoolOptions("query", 3, config);
  EXPECT_EQ(options.threads, 3);
  EXPECT_EQ(options.max_queued, 9);
  EXPECT_EQ(options.max_queued_per_group, 4);
  EXPECT_TRUE(options.yields);
  config.max_queued_queries = 1;
  EXPECT_EQ(ToViewersPoolOptions("query", 3, config).max_queued_per_group, 1);
}

}  // namespace registry_options_test
}  // namespace plumescout::server
