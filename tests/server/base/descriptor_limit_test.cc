// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/descriptor_limit.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace plumescout::server {
namespace descriptor_limit_test {

TEST(DescriptorLimitTest, TheLimitIsRaisedToWhatTheSystemAllows) {
  rlimit limit;
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlim_t before = limit.rlim_cur;
  constexpr rlim_t kFew = 256;
  ASSERT_LT(kFew, limit.rlim_max);
  limit.rlim_cur = kFew;
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
  const auto raised = RaiseDescriptorLimit();
  ASSERT_TRUE(raised.ok()) << raised.status();
  EXPECT_EQ(raised->before, static_cast<std::int64_t>(kFew));
  EXPECT_EQ(raised->now, static_cast<std::int64_t>(limit.rlim_max));
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
  EXPECT_EQ(limit.rlim_cur, limit.rlim_max);
  limit.rlim_cur = before;
  EXPECT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
}

}  // namespace descriptor_limit_test
}  // namespace plumescout::server
