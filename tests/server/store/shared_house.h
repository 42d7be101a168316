// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

#include "absl/time/time.h"
#include "server/store/postgres_missions.h"
#include "tests/server/store/shared_work.h"
#include "tests/server/store/store_work.h"

namespace plumescout::server {

// A shared store with a mission, "house", that has two records, a standing and a snapshot; node
// "n1" has it.
class SharedHouse : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(*store_->Create("house", "header"), 1);
    ASSERT_TRUE(AppendNow(*store_, "house", 1, 1, {"a", "b"}).ok());
    ASSERT_TRUE(PutStandingNow(*store_, "house", 1, "paused").ok());
    ASSERT_TRUE(PutSnapshotNow(*store_, "house", 1, {2, 7, "state"}).ok());
  }
  void Damage(const std::string& sql) { PostgresServer::Shared().Ask(url_, sql); }
  SharedRow Row() {
    const std::string keys[] = {"house"};
    return *LoadSharedRows(*connection_, keys)->at("house");
  }
  std::int64_t Done(const PostgresStatement& statement) {
    return connection_->Run(statement, absl::Seconds(30))->Int(0, 0);
  }

  const std::string url_ = PostgresServer::Shared().NewUrl();
  const std::unique_ptr<PostgresStore> store_ = OpenShared(url_);
  const std::unique_ptr<PostgresConnection> connection_ =
      PostgresConnection::Open(url_, absl::Seconds(30)).value();
};

}  // namespace plumescout::server
