// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/types/error_reason.h"
#include "server/store/postgres_schema.h"
#include "tests/server/store/shared_work.h"

namespace plumescout::server {
namespace postgres_pool_test {

class PostgresPoolTest : public ::testing::Test {
 protected:
  std::int64_t Open() {
    const auto connection = PostgresConnection::Open(url_, absl::Seconds(30)).value();
    return OpenSharedSchema(*connection, "tests").value();
  }
  static std::int64_t Backend(const PostgresPool::Loan& loan) {
    return loan->Run(PostgresStatement("SELECT pg_backend_pid()"), absl::Seconds(30))->Int(0, 0);
  }

  const std::string url_ = PostgresServer::Shared().NewUrl();
  PostgresPool pool_{url_, Open()};
};

TEST_F(PostgresPoolTest, ConnectionsAreUsedAgainUnlessTheyAreBroken) {
  const std::int64_t first = Backend(pool_.Take().value());
  EXPECT_EQ(Backend(pool_.Take().value()), first);
  {
    const PostgresPool::Loan one = pool_.Take().value();
    const PostgresPool::Loan other = pool_.Take().value();
    EXPECT_NE(Backend(one), Backend(other));
    EXPECT_FALSE(one->Run(PostgresStatement("SELECT 1 / 0"), absl::Seconds(30)).ok());
  }
  EXPECT_NE(Backend(pool_.Take().value()), first);
}

TEST_F(PostgresPoolTest, OneThatWasCutOffWhileItLayIdleIsReplaced) {
  const std::int64_t first = Backend(pool_.Take().value());
  PostgresServer::Shared().Ask(url_,
                               "SELECT pg_terminate_backend(" + std::to_string(first) + ", 10000)");
  const auto again = pool_.Take();
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_NE(Backend(*again), first);
}

TEST_F(PostgresPoolTest, ManyTakeTurns) {
  std::atomic<int> done = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 16; ++i) {
    threads.emplace_back([&] {
      for (int times = 0; times < 5; ++times) done += pool_.Take().ok() ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(done, 80);
}

TEST_F(PostgresPoolTest, AnotherStoreIsNone) {
  PostgresPool stranger(url_, 1);
  EXPECT_EQ(ErrorReason(stranger.Take().status()), reason::kStoreUnavailable);
  EXPECT_TRUE(pool_.Take().ok());
}

}  // namespace postgres_pool_test
}  // namespace plumescout::server
