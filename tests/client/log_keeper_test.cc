// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/log_keeper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "tests/client/log_traffic.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace log_keeper_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// Long enough for a loaded machine; never waited out by a passing test.
constexpr absl::Duration kPatience = absl::Seconds(20);

// A log that grows as a test says, and a disk under the keeper that does as the test says.
class LogKeeperTest : public ::testing::Test {
 protected:
  void Start(LogKeeping keeping = {absl::ZeroDuration(), absl::Milliseconds(1)}) {
    const LogSystem system = disk_.System();
    LogSystem guarded{.write =
                          [this, system](int descriptor, const void* bytes, std::size_t size) {
                            absl::MutexLock lock(&disk_mutex_);
                            return system.write(descriptor, bytes, size);
                          },
                      .sync =
                          [this, system](int descriptor) {
                            absl::MutexLock lock(&disk_mutex_);
                            return system.sync(descriptor);
                          }};
    auto opened = OpenLog(options_, "hall", "scout", 1, guarded);
    ASSERT_TRUE(opened.ok()) << opened.status();
    keeper_ = std::make_unique<LogKeeper>(
        std::move(opened->store), opened->log.last_sequence + 1, keeping,
        [this](std::int64_t next, absl::Duration timeout) { return Feed(next, timeout); },
        [this](const absl::Status& status) {
          absl::MutexLock lock(&mutex_);
          told_.push_back(status);
        });
  }
  void Append(int count) {
    absl::MutexLock lock(&mutex_);
    for (int i = 0; i < count; ++i) {
      entries_.push_back(EntryAt(entries_.empty() ? 1 : entries_.back().sequence + 1));
    }
  }
  void Renumber(const Renumbering& renumbering) {
    absl::MutexLock lock(&mutex_);
    renumberings_.push_back(renumbering);
    std::erase_if(entries_, [&](const Observation& e) { return e.sequence < renumbering.from; });
    for (Observation& entry : entries_) entry.sequence += renumbering.to - renumbering.from;
  }
  void SetMark(const LogMark& mark) {
    absl::MutexLock lock(&mutex_);
    mark_ = mark;
  }
  void SetDisk(bool full, bool syncs) {
    absl::MutexLock lock(&disk_mutex_);
    disk_.full = full;
    disk_.syncs = syncs;
  }
  // Waits until the keeper has taken all there is.
  void AwaitTaken() {
    absl::MutexLock lock(&mutex_);
    const auto taken = [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
      return entries_.empty() || asked_for_ > entries_.back().sequence;
    };
    EXPECT_TRUE(mutex_.AwaitWithTimeout(absl::Condition(&taken), kPatience));
  }
  void AwaitTold(std::size_t times) {
    absl::MutexLock lock(&mutex_);
    const auto told = [this, times]()
                          ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return told_.size() >= times; };
    EXPECT_TRUE(mutex_.AwaitWithTimeout(absl::Condition(&told), kPatience));
  }
  void End() {
    {
      absl::MutexLock lock(&mutex_);
      ended_ = true;
    }
    keeper_.reset();
  }
  KeptLog Reread() {
    auto opened = OpenLog(options_, "hall", "scout", 99);
    EXPECT_TRUE(opened.ok()) << opened.status();
    EXPECT_THAT(opened->damage, SizeIs(0));
    return std::move(opened->log);
  }
  std::vector<std::int64_t> All() {
    absl::MutexLock lock(&mutex_);
    return NumbersOf(entries_);
  }

  const TempFolder folder_;
  LogStoreOptions options_{.folder = folder_.File("log"), .segment_bytes = 2000};
  absl::Mutex mutex_;
  std::vector<absl::Status> told_ ABSL_GUARDED_BY(mutex_);
  FailingDisk disk_;  // guarded by disk_mutex_
  absl::Mutex disk_mutex_;

 private:
  LogNews Feed(std::int64_t next_sequence, absl::Duration timeout) {
    constexpr std::size_t kMostEntries = 3;
    absl::MutexLock lock(&mutex_);
    asked_for_ = next_sequence;
    const auto news = [this, next_sequence]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
      return ended_ || !renumberings_.empty() ||
             (!entries_.empty() && entries_.back().sequence >= next_sequence);
    };
    mutex_.AwaitWithTimeout(absl::Condition(&news), timeout);
    LogNews told{.renumberings = std::exchange(renumberings_, {}),
                 .entries = {},
                 .first_held_sequence = 1,
                 .mark = mark_,
                 .ended = ended_};
    for (const Renumbering& r : told.renumberings) {
      next_sequence = std::max(next_sequence, r.from) + r.to - r.from;
    }
    for (const Observation& entry : entries_) {
      if (entry.sequence >= next_sequence && told.entries.size() < kMostEntries) {
        told.entries.push_back(entry);
      }
    }
    return told;
  }

  std::vector<Observation> entries_ ABSL_GUARDED_BY(mutex_);
  std::vector<Renumbering> renumberings_ ABSL_GUARDED_BY(mutex_);
  LogMark mark_ ABSL_GUARDED_BY(mutex_);
  std::int64_t asked_for_ ABSL_GUARDED_BY(mutex_) = 0;
  bool ended_ ABSL_GUARDED_BY(mutex_) = false;
  std::unique_ptr<LogKeeper> keeper_;
};

TEST_F(LogKeeperTest, AllIsOnDiskAtTheEnd) {
  Start({absl::InfiniteDuration(), absl::Milliseconds(1)});
  Append(50);
  SetMark({7, 5});
  End();

  const KeptLog log = Reread();
  EXPECT_EQ(NumbersOf(log.entries), All());
  EXPECT_EQ(log.applied_sequence, 7);
  EXPECT_EQ(log.durable_sequence, 5);
  EXPECT_GE(disk_.sync_count, 1);
}

TEST_F(LogKeeperTest, ARenumberingStandsBetweenTheOldNumbersAndTheNew) {
  Start();
  Append(10);
  AwaitTaken();
  Renumber({6, 106});
  Append(5);
  End();

  const KeptLog log = Reread();
  EXPECT_EQ(NumbersOf(log.entries), All());
  EXPECT_EQ(log.entries.front().sequence, 106);
  EXPECT_EQ(log.entries.front().sample_time_ns, EntryAt(6).sample_time_ns);
}

TEST_F(LogKeeperTest, AFullDiskIsToldAndMadeUpForOnceThereIsRoom) {
  Start();
  Append(10);
  AwaitTaken();
  SetDisk(/*full=*/true, /*syncs=*/true);
  Append(10);
  AwaitTold(1);
  Renumber({3, 203});
  Append(10);
  SetDisk(/*full=*/false, /*syncs=*/true);
  AwaitTold(2);
  End();

  EXPECT_EQ(NumbersOf(Reread().entries), All());
  absl::MutexLock lock(&mutex_);
  EXPECT_THAT(std::string(told_[0].message()), HasSubstr("No space left"));
  EXPECT_EQ(told_[1], absl::OkStatus());
}

TEST_F(LogKeeperTest, ADiskThatDoesNotSyncIsToldAndMadeUpFor) {
  Start();
  Append(10);
  AwaitTaken();
  SetDisk(/*full=*/false, /*syncs=*/false);
  Append(10);
  AwaitTold(1);
  SetDisk(/*full=*/false, /*syncs=*/true);
  AwaitTold(2);
  Append(1);
  End();

  EXPECT_EQ(NumbersOf(Reread().entries), All());
}

TEST_F(LogKeeperTest, ADiskThatStaysFullKeepsNobodyWaitingAtTheEnd) {
  Start({absl::ZeroDuration(), absl::Hours(1)});
  SetDisk(/*full=*/true, /*syncs=*/true);
  Append(100);
  AwaitTold(1);
  End();

  absl::MutexLock lock(&mutex_);
  EXPECT_THAT(told_, ElementsAre(testing::Not(absl::OkStatus())));
}

}  // namespace log_keeper_test
}  // namespace plumescout::client
