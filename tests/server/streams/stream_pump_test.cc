// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/stream_pump.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace plumescout::server {
namespace stream_pump_test {

TEST(StreamPumpTest, RunsUntilNothingIsLeft) {
  absl::Mutex mutex;
  StreamPump pump;
  std::vector<int> ran;
  int left = 3;
  pump.Run(mutex, [&]() -> StreamPump::Operation {
    if (left == 0) return nullptr;
    return [&ran, n = left--] { ran.push_back(n); };
  });
  EXPECT_THAT(ran, testing::ElementsAre(3, 2, 1));
}

TEST(StreamPumpTest, ReactionInsideAnOperationMayPumpAgain) {
  absl::Mutex mutex;
  StreamPump pump;
  int depth = 0;
  int deepest = 0;
  int left = 3;
  std::function<void()> run;
  run = [&] {
    pump.Run(mutex, [&]() -> StreamPump::Operation {
      if (left == 0) return nullptr;
      --left;
      return [&] {
        deepest = std::max(deepest, ++depth);
        run();  // as gRPC may run a reaction within the call that starts an operation
        --depth;
      };
    });
  };
  run();
  EXPECT_EQ(left, 0);
  EXPECT_EQ(deepest, 1);  // one operation at a time
}

}  // namespace stream_pump_test
}  // namespace plumescout::server
