// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/recovery_waiters.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plumescout::server {
namespace recovery_waiters_test {

class RecoveryWaitersTest : public testing::Test {
 protected:
  RecoveryWaiters::Id Add(const std::string& key, const std::string& who) {
    return waiters_.Add(key, [this, who] { looked_.push_back(who); });
  }
  std::vector<std::string> Call(const std::vector<RecoveryWaiters::Look>& looks) {
    looked_.clear();
    for (const auto& look : looks) look();
    return looked_;
  }

  RecoveryWaiters waiters_{/*max_waiters=*/3};
  std::vector<std::string> looked_;
};

TEST_F(RecoveryWaitersTest, ThoseOfAMissionAreTakenInTheirOrder) {
  EXPECT_NE(Add("hall", "a"), 0);
  EXPECT_NE(Add("yard", "b"), 0);
  EXPECT_NE(Add("hall", "c"), 0);
  EXPECT_EQ(Call(waiters_.TakeOf("hall")), (std::vector<std::string>{"a", "c"}));
  EXPECT_TRUE(waiters_.TakeOf("hall").empty());
  EXPECT_EQ(Call(waiters_.TakeAll()), std::vector<std::string>{"b"});
  EXPECT_TRUE(waiters_.TakeAll().empty());
}

TEST_F(RecoveryWaitersTest, WhoLeavesMakesRoom) {
  const RecoveryWaiters::Id first = Add("hall", "a");
  Add("hall", "b");
  Add("yard", "c");
  EXPECT_EQ(Add("hall", "d"), 0) << "there is no room";
  EXPECT_NE(waiters_.Take(first), nullptr);
  EXPECT_EQ(waiters_.Take(first), nullptr);
  EXPECT_EQ(waiters_.Take(0), nullptr);
  EXPECT_NE(Add("hall", "d"), 0);
  EXPECT_EQ(Call(waiters_.TakeOf("hall")), (std::vector<std::string>{"b", "d"}));
}

}  // namespace recovery_waiters_test
}  // namespace plumescout::server
