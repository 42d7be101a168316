// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/request_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"

namespace plumescout::server {
namespace request_memory_test {

using ::testing::ElementsAre;

const RequestKey kKey{"t/ann", "CreateMission", "id-1"};

class RequestMemoryTest : public testing::Test {
 protected:
  RequestMemoryOptions Options() {
    RequestMemoryOptions options;
    options.clock = [this] { return now_; };
    return options;
  }
  // Notes what it is told under this name; `there`: what it answers.
  RequestMemory::Waiter Waiter(const std::string& name, bool there = true) {
    return [this, name, there](const KeptAnswer* answer) {
      told_.push_back(absl::StrCat(name, ":", answer == nullptr ? "run" : answer->bytes));
      return there;
    };
  }
  static bool Runs(RequestMemory& memory, const RequestKey& key, std::uint64_t fingerprint = 1) {
    const auto begun = memory.Begin(key, fingerprint, nullptr);
    EXPECT_TRUE(begun.ok()) << begun.status();
    return begun.ok() && begun->run;
  }

  SteadyTime now_ = SteadyTime() + std::chrono::hours(1);
  std::vector<std::string> told_;
};

TEST_F(RequestMemoryTest, TheSameRequestGetsTheSameAnswer) {
  RequestMemory memory(Options());
  ASSERT_TRUE(Runs(memory, kKey));
  memory.Conclude(kKey, KeptAnswer{"lease 7"});
  const auto again = memory.Begin(kKey, 1, nullptr);
  ASSERT_TRUE(again.ok());
  EXPECT_FALSE(again->run);
  ASSERT_TRUE(again->answer.has_value());
  EXPECT_EQ(again->answer->bytes, "lease 7");
}

TEST_F(RequestMemoryTest, CallersMethodsAndIdsAreApart) {
  RequestMemory memory(Options());
  ASSERT_TRUE(Runs(memory, kKey));
  memory.Conclude(kKey, KeptAnswer{"1"});
  EXPECT_TRUE(Runs(memory, {"t/bob", kKey.method, kKey.request_id}));
  EXPECT_TRUE(Runs(memory, {kKey.caller, "RegisterRobot", kKey.request_id}));
  EXPECT_TRUE(Runs(memory, {kKey.caller, kKey.method, "id-2"}));
}

TEST_F(RequestMemoryTest, AnotherRequestOfTheSameIdIsRefused) {
  RequestMemory memory(Options());
  ASSERT_TRUE(Runs(memory, kKey, 1));
  EXPECT_TRUE(absl::IsInvalidArgument(memory.Begin(kKey, 2, nullptr).status()));
  memory.Conclude(kKey, KeptAnswer{"1"});
  EXPECT_TRUE(absl::IsInvalidArgument(memory.Begin(kKey, 2, nullptr).status()));
}

TEST_F(RequestMemoryTest, WhoComesWhileItRunsWaitsForTheAnswer) {
  RequestMemory memory(Options());
  ASSERT_TRUE(Runs(memory, kKey));
  for (const char* name : {"a", "b"}) {
    const auto begun = memory.Begin(kKey, 1, Waiter(name));
    ASSERT_TRUE(begun.ok());
    EXPECT_FALSE(begun->run || begun->answer.has_value());
  }
  EXPECT_TRUE(told_.empty());
  memory.Conclude(kKey, KeptAnswer{"7"});
  EXPECT_THAT(told_, ElementsAre("a:7", "b:7"));
}

TEST_F(RequestMemoryTest, IfItComesToNothingTheNextOneWhoIsThereRuns) {
  RequestMemory memory(Options());
  ASSERT_TRUE(Runs(memory, kKey));
  ASSERT_TRUE(memory.Begin(kKey, 1, Waiter("gone", false)).ok());
  ASSERT_TRUE(memory.Begin(kKey, 1, Waiter("a")).ok());
  ASSERT_TRUE(memory.Begin(kKey, 1, Waiter("b")).ok());
  memory.Conclude(kKey, std::nullopt);
  EXPECT_THAT(told_, ElementsAre("gone:run", "a:run"));
  memory.Conclude(kKey, KeptAnswer{"8"});  // of a
  EXPECT_THAT(told_, ElementsAre("gone:run", "a:run", "b:8"));
}

TEST_F(RequestMemoryTest, AFailureIsForgotten) {
  RequestMemory memory(Options());
  ASSERT_TRUE(Runs(memory, kKey));
  memory.Conclude(kKey, std::nullopt);
  EXPECT_TRUE(Runs(memory, kKey, 2));
}

TEST_F(RequestMemoryTest, TooManyWhoWaitAreRefused) {
  RequestMemoryOptions options = Options();
  options.max_waiting = 1;
  RequestMemory memory(options);
  ASSERT_TRUE(Runs(memory, kKey));
  ASSERT_TRUE(memory.Begin(kKey, 1, Waiter("a")).ok());
  EXPECT_EQ(ErrorReason(memory.Begin(kKey, 1, Waiter("b")).status()), reason::kOverloaded);
}

TEST_F(RequestMemoryTest, AnswersGrowTooOld) {
  RequestMemoryOptions options = Options();
  options.max_age = absl::Minutes(10);
  RequestMemory memory(options);
  ASSERT_TRUE(Runs(memory, kKey));
  memory.Conclude(kKey, KeptAnswer{"7"});
  now_ += std::chrono::minutes(10) - std::chrono::nanoseconds(1);
  EXPECT_FALSE(Runs(memory, kKey));
  now_ += std::chrono::nanoseconds(1);
  EXPECT_TRUE(Runs(memory, kKey));
}

TEST_F(RequestMemoryTest, TheOldestGoFirstByNumberAndByBytes) {
  RequestMemoryOptions options = Options();
  options.max_answers = 3;
  options.max_bytes = 100;
  RequestMemory memory(options);
  const auto key = [](int i) { return RequestKey{"", "", absl::StrCat(i)}; };
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(Runs(memory, key(i)));
    memory.Conclude(key(i), KeptAnswer{std::string(10, 'x')});
  }
  EXPECT_FALSE(Runs(memory, key(1)));
  EXPECT_TRUE(Runs(memory, key(0)));
  memory.Conclude(key(0), KeptAnswer{std::string(85, 'x')});  // room for one more of the ten
  EXPECT_FALSE(Runs(memory, key(0)));
  EXPECT_FALSE(Runs(memory, key(3)));
  EXPECT_TRUE(Runs(memory, key(2)));
  memory.Conclude(key(2), KeptAnswer{std::string(101, 'x')});  // more than all
  EXPECT_TRUE(Runs(memory, key(2)));
}

TEST_F(RequestMemoryTest, ManyAnswersOfOneMethodPushOutTheirOwnKind) {
  RequestMemoryOptions options = Options();
  options.max_answers = 4;
  options.max_bytes = 100;
  RequestMemory memory(options);
  ASSERT_TRUE(Runs(memory, kKey));
  memory.Conclude(kKey, KeptAnswer{"lease 7"});
  const auto plan = [](int i) {
    return RequestKey{kKey.caller, "NextBestTrajectory", absl::StrCat(i)};
  };
  for (int i = 0; i < 9; ++i) {
    ASSERT_TRUE(Runs(memory, plan(i)));
    memory.Conclude(plan(i), KeptAnswer{std::string(i < 8 ? 10 : 80, 'x')});
  }
  EXPECT_FALSE(Runs(memory, kKey));
  EXPECT_FALSE(Runs(memory, plan(8)));
  EXPECT_TRUE(Runs(memory, plan(5)));
}

TEST_F(RequestMemoryTest, WhatWasUndoneIsForgottenUnlessItRuns) {
  RequestMemory memory(Options());
  ASSERT_TRUE(Runs(memory, kKey));
  memory.Forget(kKey);
  ASSERT_TRUE(memory.Begin(kKey, 1, Waiter("a")).ok());
  memory.Conclude(kKey, KeptAnswer{"7"});
  EXPECT_THAT(told_, ElementsAre("a:7"));
  memory.Forget(kKey);
  EXPECT_TRUE(Runs(memory, kKey));
}

// What never becomes certain by itself.
class Doubt final : public Proviso {
 public:
  void Await(Heard) const override {}
  bool IsOpen() const override { return true; }
};

TEST_F(RequestMemoryTest, AnAnswerUnderAProvisoIsToldWithItUntilItIsSettled) {
  RequestMemory memory(Options());
  const auto doubt = std::make_shared<const Doubt>();
  ASSERT_TRUE(Runs(memory, kKey));
  memory.Conclude(kKey, KeptAnswer{"7", doubt});
  EXPECT_EQ(memory.Begin(kKey, 1, nullptr)->answer->proviso, doubt);
  const Doubt other;
  memory.Settle(kKey, &other, false);
  memory.Settle(kKey, doubt.get(), true);
  memory.Settle(kKey, doubt.get(), false);  // it has been settled
  const auto again = memory.Begin(kKey, 1, nullptr);
  ASSERT_TRUE(again.ok() && again->answer.has_value());
  EXPECT_EQ(again->answer->bytes, "7");
  EXPECT_EQ(again->answer->proviso, nullptr);
}

TEST_F(RequestMemoryTest, AnAnswerWhoseProvisoFailsIsForgotten) {
  RequestMemory memory(Options());
  const auto doubt = std::make_shared<const Doubt>();
  ASSERT_TRUE(Runs(memory, kKey));
  memory.Conclude(kKey, KeptAnswer{"7", doubt});
  memory.Settle(kKey, doubt.get(), false);
  EXPECT_TRUE(Runs(memory, kKey));
  memory.Settle(kKey, doubt.get(), false);  // it runs
  EXPECT_FALSE(Runs(memory, kKey));
}

TEST_F(RequestMemoryTest, AnswersUnderAProvisoTakeRoomAsOthersDo) {
  RequestMemoryOptions options = Options();
  options.max_answers = 1;
  RequestMemory memory(options);
  const RequestKey other{kKey.caller, kKey.method, "id-2"};
  for (const RequestKey& key : {kKey, other}) {
    ASSERT_TRUE(Runs(memory, key));
    memory.Conclude(key, KeptAnswer{"7", std::make_shared<const Doubt>()});
  }
  EXPECT_FALSE(Runs(memory, other));
  EXPECT_TRUE(Runs(memory, kKey));
}

}  // namespace request_memory_test
}  // namespace plumescout::server
