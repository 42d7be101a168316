// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/observe/process_usage.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace plumescout::server {
namespace process_usage_test {

TEST(ProcessUsageTest, FiguresAreOfThisProcess) {
  const ProcessUsage usage = ReadProcessUsage();
  EXPECT_GT(usage.resident_bytes, 1'000'000);
  EXPECT_GE(usage.open_fds, 3);
  EXPECT_GT(usage.max_fds, usage.open_fds);
  EXPECT_GT(usage.cpu_s, 0.0);
  EXPECT_GE(usage.threads, 1);
}

TEST(ProcessUsageTest, DescriptorsAreCounted) {
  const int before = ReadProcessUsage().open_fds;
  const int fd = open("/dev/null", O_RDONLY | O_CLOEXEC);
  EXPECT_EQ(ReadProcessUsage().open_fds, before + 1);
  close(fd);
  EXPECT_EQ(ReadProcessUsage().open_fds, before);
}

}  // namespace process_usage_test
}  // namespace plumescout::server
