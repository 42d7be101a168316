// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/rpc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "absl/strings/str_cat.h"
#include "tests/server/wire_methods.h"

namespace plumescout::server {
namespace rpc_test {

using ::testing::HasSubstr;

std::string NameOf(const RpcRow& row) { return absl::StrCat(row.service, ".", row.method); }

TEST(RpcTest, EveryMethodHasARowAndEveryRowAMethod) {
  std::multiset<std::string> methods;
  for (const auto* method : WireMethods()) methods.insert(ShortName(*method));
  std::multiset<std::string> rows;
  for (const RpcRow& row : RpcTable()) rows.insert(NameOf(row));
  EXPECT_EQ(rows, methods);
}

TEST(RpcTest, AdminsMayDoEverything) {
  for (const RpcRow& row : RpcTable()) EXPECT_TRUE(IsAllowed(Role::kAdmin, row.rpc)) << row.method;
}

TEST(RpcTest, RolesMayDoWhatTheyAreFor) {
  EXPECT_TRUE(IsAllowed(Role::kRobot, Rpc::kStreamObservations));
  EXPECT_FALSE(IsAllowed(Role::kRobot, Rpc::kCreateMission));
  EXPECT_FALSE(IsAllowed(Role::kRobot, Rpc::kDeleteMission));
  EXPECT_TRUE(IsAllowed(Role::kViewer, Rpc::kWatchMap));
  EXPECT_FALSE(IsAllowed(Role::kViewer, Rpc::kRegisterRobot));
  EXPECT_TRUE(IsAllowed(Role::kOperator, Rpc::kDeleteMission));
  EXPECT_FALSE(IsAllowed(Role::kOperator, Rpc::kDrainServer));
}

// Viewers change nothing: what they may call only reads.
TEST(RpcTest, ViewersOnlyRead) {
  for (const RpcRow& row : RpcTable()) {
    if (!row.viewer) continue;
    const std::string method(row.method);
    const bool reads = method.rfind("Get", 0) == 0 || method.rfind("List", 0) == 0 ||
                       method == "WatchMap" || method == "QueryGas";
    EXPECT_TRUE(reads) << method;
  }
}

TEST(RpcTest, TheManualHasTheSameTable) {
  std::ostringstream manual;
  manual << std::ifstream("docs/operations.md").rdbuf();
  const auto mark = [](bool allowed) { return allowed ? "yes" : "–"; };
  for (const RpcRow& row : RpcTable()) {
    EXPECT_THAT(manual.str(),
                HasSubstr(absl::StrCat("| `", NameOf(row), "` | ", mark(row.robot), " | ",
                                       mark(row.viewer), " | ", mark(row.op), " | yes |\n")));
  }
}

}  // namespace rpc_test
}  // namespace plumescout::server
