// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/committer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <string>
#include <vector>

#include "core/types/error_reason.h"
#include "server/store/store_errors.h"
#include "tests/server/store/store_work.h"

namespace plumescout::server {
namespace committer_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Kind = StoreWrite::Kind;

// Notes the keys of each batch, and answers as it is told; OK when it is told no more.
class ScriptedEngine final : public WriteEngine {
 public:
  absl::Status Commit(std::span<StoreWrite> writes) override {
    absl::MutexLock lock(&mutex_);
    std::vector<std::string> keys;
    bool is_poisoned = false;
    for (StoreWrite& write : writes) {
      keys.push_back(absl::StrCat(write.tried ? "again " : "", write.key));
      write.inserted = write.kind == Kind::kCreate;
      is_poisoned = is_poisoned || write.key == "poison";
    }
    batches_.push_back(keys);
    if (is_poisoned) return StoreDamaged("the file");
    if (answers_.empty()) return absl::OkStatus();
    const absl::Status answer = answers_.front();
    if (answers_.size() > 1 || answer.ok() || !for_ever_) answers_.pop_front();
    return answer;
  }

  void Tidy() override { ++tidied_; }

  void AnswerWith(std::deque<absl::Status> answers, bool for_ever = false) {
    absl::MutexLock lock(&mutex_);
    answers_ = std::move(answers);
    for_ever_ = for_ever;
  }
  std::vector<std::vector<std::string>> batches() const {
    absl::MutexLock lock(&mutex_);
    return batches_;
  }
  int tidied() const { return tidied_; }

 private:
  mutable absl::Mutex mutex_;
  std::deque<absl::Status> answers_;
  bool for_ever_ = false;
  std::vector<std::vector<std::string>> batches_;
  std::atomic<int> tidied_ = 0;
};

StoreWrite Write(Kind kind, const std::string& key, MissionStore::Done done = nullptr,
                 std::vector<std::string> records = {"record"}) {
  StoreWrite write;
  write.kind = kind;
  write.key = key;
  write.records = std::move(records);
  write.done = std::move(done);
  return write;
}

absl::Status Full() { return StoreUnavailable("/data/store.db: full"); }

CommitterOptions Quick() {
  CommitterOptions options;
  options.retry_period = absl::Milliseconds(1);
  return options;
}

// A committer whose first commit waits, so that what comes meanwhile gathers.
class Gathering {
 public:
  explicit Gathering(const CommitterOptions& options) : committer_(options, &engine_) {
    StoreWrite first = Write(Kind::kAppend, "first", [this](const absl::Status&) {
      told_.Notify();
      gathered_.WaitForNotification();
    });
    committer_.Submit(std::move(first));
    told_.WaitForNotification();
  }
  ~Gathering() {
    if (!gathered_.HasBeenNotified()) gathered_.Notify();
  }

  ScriptedEngine& engine() { return engine_; }
  Committer& committer() { return committer_; }
  void Go() { gathered_.Notify(); }

 private:
  ScriptedEngine engine_;
  absl::Notification told_;
  absl::Notification gathered_;
  Committer committer_;
};

TEST(Committer, WhatGathersGoesIntoOneCommit) {
  Gathering gathering(Quick());
  Told last;
  gathering.committer().Submit(Write(Kind::kAppend, "a"));
  gathering.committer().Submit(Write(Kind::kStanding, "b"));
  gathering.committer().Submit(Write(Kind::kAppend, "a", last.done()));
  EXPECT_EQ(gathering.committer().state().backlog_records, 3);
  EXPECT_EQ(gathering.committer().state().backlog_bytes, 3 * 6);
  gathering.Go();
  EXPECT_TRUE(last.Wait().ok());
  EXPECT_THAT(gathering.engine().batches(),
              ElementsAre(ElementsAre("first"), ElementsAre("a", "b", "a")));
  EXPECT_EQ(gathering.committer().state().commits, 2);
  EXPECT_EQ(gathering.committer().state().backlog_bytes, 0);
}

TEST(Committer, ABatchIsBounded) {
  CommitterOptions options = Quick();
  options.max_batch_records = 3;
  options.max_batch_bytes = 100;
  Gathering gathering(options);
  Told last;
  const std::string large(90, 'x');
  gathering.committer().Submit(Write(Kind::kAppend, "a", nullptr, {"1", "2"}));
  gathering.committer().Submit(Write(Kind::kAppend, "b", nullptr, {"3", "4"}));
  gathering.committer().Submit(Write(Kind::kAppend, "c", nullptr, {large}));
  gathering.committer().Submit(Write(Kind::kAppend, "d", nullptr, {large}));
  gathering.committer().Submit(Write(Kind::kAppend, "e", nullptr, {"1", "2", "3", "4", "5"}));
  gathering.committer().Submit(Write(Kind::kAppend, "f", last.done()));
  gathering.Go();
  EXPECT_TRUE(last.Wait().ok());
  EXPECT_THAT(gathering.engine().batches(),
              ElementsAre(ElementsAre("first"), ElementsAre("a"), ElementsAre("b", "c"),
                          ElementsAre("d"), ElementsAre("e"), ElementsAre("f")));
}

TEST(Committer, ASnapshotIsCommittedAlone) {
  Gathering gathering(Quick());
  Told last;
  gathering.committer().Submit(Write(Kind::kAppend, "a"));
  gathering.committer().Submit(Write(Kind::kSnapshot, "b"));
  gathering.committer().Submit(Write(Kind::kAppend, "c", last.done()));
  gathering.Go();
  EXPECT_TRUE(last.Wait().ok());
  EXPECT_THAT(gathering.engine().batches(), ElementsAre(ElementsAre("first"), ElementsAre("a"),
                                                        ElementsAre("b"), ElementsAre("c")));
}

TEST(Committer, WhatTheDiskRefusesIsTriedAgain) {
  Gathering gathering(Quick());
  gathering.engine().AnswerWith({Full(), Full(), Full()});
  Told first;
  Told second;
  gathering.committer().Submit(Write(Kind::kAppend, "a", first.done()));
  gathering.committer().Submit(Write(Kind::kRemove, "b", second.done()));
  gathering.Go();
  EXPECT_TRUE(first.Wait().ok());
  EXPECT_TRUE(second.Wait().ok());
  EXPECT_THAT(
      gathering.engine().batches(),
      ElementsAre(ElementsAre("first"), ElementsAre("a", "b"), ElementsAre("again a", "again b"),
                  ElementsAre("again a", "again b"), ElementsAre("again a", "again b")));
  EXPECT_TRUE(gathering.committer().state().status.ok());
}

TEST(Committer, WhoDoesNotWaitHearsOfAFullDiskAtOnce) {
  ScriptedEngine engine;
  engine.AnswerWith({Full()}, /*for_ever=*/true);
  CommitterOptions options = Quick();
  absl::Notification warned;
  options.warn = [&](absl::string_view what) {
    EXPECT_THAT(std::string(what), HasSubstr("/data/store.db"));
    if (!warned.HasBeenNotified()) warned.Notify();
  };
  Told append;
  {
    Committer committer(options, &engine);
    committer.Submit(Write(Kind::kAppend, "a", append.done()));
    warned.WaitForNotification();
    for (const Kind kind : {Kind::kCreate, Kind::kAcquire, Kind::kSnapshot, Kind::kCompact}) {
      const absl::Status status = committer.SubmitAndWait(Write(kind, "b"));
      EXPECT_EQ(ErrorReason(status), reason::kStoreUnavailable) << status;
    }
    EXPECT_EQ(ErrorReason(committer.state().status), reason::kStoreUnavailable);
    EXPECT_EQ(committer.state().backlog_records, 1);
    EXPECT_FALSE(append.is_told());
  }
  EXPECT_TRUE(absl::IsCancelled(append.Wait()));
}

TEST(Committer, AnUncertainCreateIsTakenBack) {
  ScriptedEngine engine;
  engine.AnswerWith({Full()});
  Committer committer(Quick(), &engine);
  EXPECT_TRUE(absl::IsUnavailable(committer.SubmitAndWait(Write(Kind::kCreate, "a"))));
  EXPECT_TRUE(committer.SubmitAndWait(Write(Kind::kAppend, "b")).ok());
  EXPECT_THAT(engine.batches(),
              ElementsAre(ElementsAre("a"), ElementsAre("again a"), ElementsAre("b")));
  EXPECT_EQ(committer.state().backlog_bytes, 0);
}

TEST(Committer, ADiskThatIsWellAgainIsFoundOutWithoutAWrite) {
  ScriptedEngine engine;
  engine.AnswerWith({Full()}, /*for_ever=*/true);
  CommitterOptions options = Quick();
  absl::Notification well;
  options.warn = [&](absl::string_view what) {
    if (what == "the store works again") well.Notify();
  };
  Committer committer(options, &engine);
  EXPECT_TRUE(absl::IsUnavailable(committer.SubmitAndWait(Write(Kind::kSnapshot, "a"))));
  engine.AnswerWith({});
  well.WaitForNotification();
  EXPECT_TRUE(committer.state().status.ok());
}

TEST(Committer, OnlyTheDamagedHearOfDamage) {
  Gathering gathering(Quick());
  Told before;
  Told damaged;
  Told behind;
  gathering.committer().Submit(Write(Kind::kAppend, "a", before.done()));
  gathering.committer().Submit(Write(Kind::kAppend, "poison", damaged.done()));
  gathering.committer().Submit(Write(Kind::kAppend, "b", behind.done()));
  gathering.Go();
  EXPECT_TRUE(before.Wait().ok());
  EXPECT_TRUE(absl::IsDataLoss(damaged.Wait()));
  EXPECT_TRUE(behind.Wait().ok());
  EXPECT_TRUE(gathering.committer().state().status.ok());
}

TEST(Committer, SlowCommitsAreCountedAndWarnedOf) {
  ScriptedEngine engine;
  CommitterOptions options = Quick();
  options.slow_commit = -absl::Seconds(1);  // all are
  std::vector<std::string> warnings;
  options.warn = [&](absl::string_view what) { warnings.emplace_back(what); };
  {
    Committer committer(options, &engine);
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(committer.SubmitAndWait(Write(Kind::kAppend, "a")).ok());
    }
    EXPECT_EQ(committer.state().slow_commits, 3);
  }
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("a commit took")));  // one is enough for a while
  EXPECT_EQ(engine.tidied(), 3);
}

TEST(Committer, WhoIsClosedCancelsWhatWaits) {
  ScriptedEngine engine;
  Told answer;
  {
    engine.AnswerWith({Full()}, /*for_ever=*/true);
    Committer committer(Quick(), &engine);
    committer.Submit(Write(Kind::kAppend, "a"));
    committer.Submit(Write(Kind::kAppend, "b", answer.done()));
  }
  EXPECT_TRUE(absl::IsCancelled(answer.Wait()));
}

}  // namespace committer_test
}  // namespace plumescout::server
