// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/config/config_file.h"
#include "tests/architecture/source_tree.h"

namespace plumescout {
namespace shipped_configs_test {

using testing::IsEmpty;
using testing::Not;

TEST(ShippedConfigs, EveryOneLoads) {
  for (const char* folder : {"deploy/config", "deploy/cluster"}) {
    const auto paths = ListFiles(folder, ".yaml");
    ASSERT_THAT(paths, Not(IsEmpty())) << folder;
    for (const std::string& path : paths) {
      server::ConfigBuilder builder;
      EXPECT_EQ(builder.AddFile(path), absl::OkStatus()) << path;
      EXPECT_EQ(builder.Build().status(), absl::OkStatus()) << path;
    }
  }
}

}  // namespace shipped_configs_test
}  // namespace plumescout
