// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What no one statement shows: batches of many missions, others who write, and a database that goes
// away in the middle.
#include "server/store/postgres_engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"
#include "server/store/postgres_schema.h"
#include "tests/server/store/shared_work.h"
#include "tests/server/store/store_work.h"

namespace plumescout::server {
namespace postgres_engine_test {

using Kind = StoreWrite::Kind;

class PostgresEngineTest : public ::testing::Test {
 protected:
  std::unique_ptr<PostgresEngine> MakeEngine() {
    const auto connection = PostgresConnection::Open(url_, absl::Seconds(30)).value();
    PostgresEngineOptions options;
    options.url = url_;
    options.store = OpenSharedSchema(*connection, "tests").value();
    options.lease = [this] { return lease_; };
    lease_ = std::stoll(PostgresServer::Shared().Ask(url_, "SELECT id FROM plumescout_node"));
    return std::make_unique<PostgresEngine>(std::move(options));
  }
  static StoreWrite Write(Kind kind, const std::string& key, std::int64_t epoch) {
    StoreWrite write;
    write.kind = kind;
    write.key = key;
    write.epoch = epoch;
    return write;
  }
  static StoreWrite AppendOf(const std::string& key, std::int64_t epoch, std::int64_t first,
                             std::vector<std::string> records) {
    StoreWrite write = Write(Kind::kAppend, key, epoch);
    write.first_number = first;
    write.records = std::move(records);
    return write;
  }

  // What the engine may write to is what it made or took over itself.
  static void Make(PostgresEngine& engine, const std::string& key) {
    std::vector<StoreWrite> batch;
    batch.push_back(Write(Kind::kCreate, key, 1));
    ASSERT_TRUE(engine.Commit(batch).ok());
    ASSERT_TRUE(batch[0].result.ok()) << batch[0].result;
  }
  static void AppendTo(PostgresEngine& engine, const std::string& key,
                       std::vector<std::string> records) {
    std::vector<StoreWrite> batch;
    batch.push_back(AppendOf(key, 1, 1, std::move(records)));
    ASSERT_TRUE(engine.Commit(batch).ok());
    ASSERT_TRUE(batch[0].result.ok()) << batch[0].result;
  }

  const std::string url_ = PostgresServer::Shared().NewUrl();
  const std::unique_ptr<PostgresStore> store_ = OpenShared(url_);
  std::int64_t lease_ = 0;
};

TEST_F(PostgresEngineTest, OneBatchHoldsManyWritesOfManyMissions) {
  const auto engine = MakeEngine();
  std::vector<StoreWrite> batch;
  for (const char* key : {"house", "mill"}) {
    batch.push_back(Write(Kind::kCreate, key, 1));
    batch.push_back(AppendOf(key, 1, 1, {"a", "b"}));
    batch.push_back(AppendOf(key, 1, 3, {"c"}));
    batch.push_back(AppendOf(key, 1, 5, {"gap"}));
    batch.push_back(Write(Kind::kStanding, key, 1));
    batch.back().bytes = "first";
    batch.push_back(Write(Kind::kStanding, key, 1));
    batch.back().bytes = "paused";
    batch.push_back(AppendOf(key, 2, 4, {"of a later epoch"}));
  }
  ASSERT_TRUE(engine->Commit(batch).ok());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const bool is_refused = i % 7 == 3 || i % 7 == 6;
    EXPECT_EQ(ErrorReason(batch[i].result), is_refused ? reason::kFenced : "") << i;
  }
  for (const char* key : {"house", "mill"}) {
    const std::vector<JournalRecord> all = {{1, "a"}, {2, "b"}, {3, "c"}};
    EXPECT_EQ(*ReadAll(*store_, key), all);
    EXPECT_EQ(store_->Peek(key)->standing, "paused");
  }
  EXPECT_EQ(store_->List()->front().bytes, 3 + 6);
}

TEST_F(PostgresEngineTest, WhatComesLateForAMissionThatIsGoneLeavesItsNamesakeAlone) {
  const auto other = OpenShared(url_, "n2");
  ASSERT_EQ(*store_->Create("house", "old"), 1);
  ASSERT_TRUE(store_->nodes()->Release("house", 1).ok());
  const std::int64_t taken = other->Acquire("house")->epoch;
  ASSERT_TRUE(RemoveNow(*other, "house", taken).ok());
  ASSERT_EQ(*other->Create("house", "new"), 1);
  EXPECT_EQ(ErrorReason(AppendNow(*store_, "house", 1, 1, {"late"})), reason::kFenced);
  EXPECT_EQ(ErrorReason(RemoveNow(*store_, "house", 1)), reason::kFenced);
  EXPECT_EQ(other->Peek("house")->header, "new");
  EXPECT_TRUE(AppendNow(*other, "house", 1, 1, {"first"}).ok());
  EXPECT_EQ(*ReadAll(*other, "house"), (std::vector<JournalRecord>{{1, "first"}}));
}

TEST_F(PostgresEngineTest, WhoWasOvertakenIsFencedAndTheRestOfTheBatchStands) {
  const auto engine = MakeEngine();
  Make(*engine, "house");
  Make(*engine, "mill");
  std::vector<StoreWrite> batch;
  batch.push_back(AppendOf("house", 1, 1, {"a"}));
  batch.push_back(AppendOf("mill", 1, 1, {"a"}));
  ASSERT_TRUE(engine->Commit(batch).ok());
  EXPECT_TRUE(batch[0].result.ok());

  ASSERT_EQ(store_->Acquire("house")->epoch, 2);  // this engine does not know yet
  batch.clear();
  batch.push_back(AppendOf("house", 1, 2, {"of a zombie"}));
  batch.push_back(AppendOf("mill", 1, 2, {"b"}));
  batch.push_back(AppendOf("house", 1, 3, {"of a zombie"}));
  ASSERT_TRUE(engine->Commit(batch).ok());
  EXPECT_EQ(ErrorReason(batch[0].result), reason::kFenced);
  EXPECT_TRUE(batch[1].result.ok()) << batch[1].result;
  EXPECT_EQ(ErrorReason(batch[2].result), reason::kFenced);
  EXPECT_EQ(ReadAll(*store_, "house")->size(), 1U);
  EXPECT_EQ(ReadAll(*store_, "mill")->size(), 2U);
}

TEST_F(PostgresEngineTest, WhatWasWrittenAlreadyIsNotWrittenTwice) {
  const auto engine = MakeEngine();
  Make(*engine, "house");
  AppendTo(*engine, "house", {"a", "b"});
  std::vector<StoreWrite> batch;
  batch.push_back(AppendOf("house", 1, 1, {"a", "b"}));
  batch.push_back(AppendOf("house", 1, 1, {"a", "other"}));
  batch.push_back(AppendOf("house", 1, 3, {"c"}));
  for (StoreWrite& write : batch) write.tried = true;
  ASSERT_TRUE(engine->Commit(batch).ok());
  EXPECT_TRUE(batch[0].result.ok()) << batch[0].result;
  EXPECT_EQ(ErrorReason(batch[1].result), reason::kFenced);
  EXPECT_TRUE(batch[2].result.ok()) << batch[2].result;
  EXPECT_EQ(ReadAll(*store_, "house")->size(), 3U);
}

TEST_F(PostgresEngineTest, BatchesThatMeetDoNotWaitInACircle) {
  const auto first = MakeEngine();
  const auto second = MakeEngine();
  const auto blocker = PostgresConnection::Open(url_, absl::Seconds(30)).value();
  const auto block = [&](const char* sql) {
    ASSERT_TRUE(blocker->Run(PostgresStatement(sql), absl::Seconds(30)).ok()) << sql;
  };
  const auto waiting = [this](int count) {
    return Eventually([&] {
      return PostgresServer::Shared().Ask(
                 url_, "SELECT count(*) FROM pg_stat_activity WHERE wait_event_type = 'Lock'") ==
             std::to_string(count);
    });
  };
  const auto make = [](PostgresEngine& engine, std::vector<std::string> keys) {
    return std::async(std::launch::async, [&engine, keys] {
      std::vector<StoreWrite> batch;
      for (const std::string& key : keys) batch.push_back(Write(Kind::kCreate, key, 1));
      const absl::Status status = engine.Commit(batch);
      if (!status.ok()) return status.ToString();
      return absl::StrCat(batch[0].result.ok(), batch[1].result.ok());
    });
  };
  block("BEGIN");
  block("INSERT INTO plumescout_mission(id, key, header, crc) VALUES(0, 'house', '', 0)");
  auto ahead = make(*first, {"house", "mill"});
  ASSERT_TRUE(waiting(1));
  // If it had the mill already when it comes to the house, neither could go on.
  auto behind = make(*second, {"mill", "house"});
  ASSERT_TRUE(waiting(2));
  block("ROLLBACK");
  const std::vector<std::string> answers = {ahead.get(), behind.get()};
  EXPECT_THAT(answers, ::testing::UnorderedElementsAre("11", "00"));
}

TEST_F(PostgresEngineTest, ACreationThatWasAnsweredWithAnErrorIsTakenBack) {
  const auto engine = MakeEngine();
  std::vector<StoreWrite> batch;
  batch.push_back(Write(Kind::kCreate, "house", 1));
  batch.back().bytes = "header";
  ASSERT_TRUE(engine->Commit(batch).ok());
  EXPECT_TRUE(batch[0].inserted);
  batch[0] = Write(Kind::kUndoCreate, "house", 0);
  batch[0].bytes = "another's header";
  ASSERT_TRUE(engine->Commit(batch).ok());
  EXPECT_TRUE(store_->Peek("house").ok());
  batch[0].bytes = "header";
  ASSERT_TRUE(engine->Commit(batch).ok());
  EXPECT_TRUE(absl::IsNotFound(store_->Peek("house").status()));
  ASSERT_TRUE(engine->Commit(batch).ok());
  EXPECT_TRUE(batch[0].result.ok());
}

TEST_F(PostgresEngineTest, WithoutALeaseNothingIsMadeOrTaken) {
  const auto engine = MakeEngine();
  ASSERT_EQ(*store_->Create("house", ""), 1);
  for (const std::int64_t lease : {std::int64_t{0}, lease_ + 1000}) {
    lease_ = lease;
    for (const Kind kind : {Kind::kCreate, Kind::kAcquire}) {
      std::vector<StoreWrite> batch;
      batch.push_back(Write(kind, kind == Kind::kCreate ? "mill" : "house", 1));
      const absl::Status status = engine->Commit(batch);
      EXPECT_FALSE(status.ok() && batch[0].result.ok());
    }
  }
  EXPECT_EQ(store_->List()->size(), 1U);
  EXPECT_EQ(store_->Peek("house")->epoch, 1);
}

TEST_F(PostgresEngineTest, ChoresEndOnceAllIsDone) {
  const auto engine = MakeEngine();
  Make(*engine, "house");
  AppendTo(*engine, "house", Records("house", 1, 700));
  std::vector<StoreWrite> batch;
  batch.push_back(Write(Kind::kRemove, "house", 1));
  ASSERT_TRUE(engine->Commit(batch).ok());
  for (int i = 0; i < 100 && engine->has_chores(); ++i) {
    ASSERT_EQ(engine->Commit({}), absl::OkStatus());
  }
  EXPECT_FALSE(engine->has_chores());
  const auto count = [&](const std::string& table) {
    return PostgresServer::Shared().Ask(url_, "SELECT count(*) FROM plumescout_" + table);
  };
  EXPECT_EQ(count("record"), "0");
  EXPECT_EQ(count("removed"), "0");
  EXPECT_TRUE(engine->Commit({}).ok()) << "a probe";
}

TEST_F(PostgresEngineTest, NothingIsLostOrDoubledWhileTheDatabaseComesAndGoes) {
  constexpr int kAppends = 300;
  ASSERT_EQ(*store_->Create("house", ""), 1);
  std::vector<Told> told(kAppends);
  for (int i = 0; i < kAppends; ++i) {
    if (i % 100 == 50) PostgresServer::Shared().Kill();
    if (i % 100 == 80) PostgresServer::Shared().Start();
    store_->Append("house", 1, 1 + 2 * i, Records("house", 1 + 2 * i, 2),
                   told[static_cast<std::size_t>(i)].done());
    if (i % 10 == 0) absl::SleepFor(absl::Milliseconds(5));
  }
  for (Told& answer : told) EXPECT_TRUE(answer.Wait().ok());
  EXPECT_EQ(*ReadAll(*store_, "house"), Numbered("house", 1, 2 * kAppends));
  EXPECT_TRUE(store_->state().status.ok());
}

}  // namespace postgres_engine_test
}  // namespace plumescout::server
