// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/map_replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <utility>

#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"
#include "server/maps/wire_message.h"
#include "tests/server/history/past_run.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace map_replay_test {

using Frame = v1::WatchMapResponse;

// Keeps what it gets.
class Reader final : public MapReader {
 public:
  void Take(std::shared_ptr<const MapFrames> frames) override {
    absl::MutexLock lock(&mutex_);
    taken_.push_back(std::move(frames));
  }
  void End(const absl::Status& status) override {
    absl::MutexLock lock(&mutex_);
    end_ = status;
    ended_ = true;
  }
  // Null: it has ended.
  std::shared_ptr<const MapFrames> Next() {
    absl::MutexLock lock(&mutex_);
    mutex_.Await(absl::Condition(this, &Reader::HasNews));
    if (taken_.empty()) return nullptr;
    auto first = taken_.front();
    taken_.pop_front();
    return first;
  }
  absl::Status end() {
    absl::MutexLock lock(&mutex_);
    return end_;
  }

 private:
  bool HasNews() const { return !taken_.empty() || ended_; }

  absl::Mutex mutex_;
  std::deque<std::shared_ptr<const MapFrames>> taken_;
  absl::Status end_;
  bool ended_ = false;
};

class MapReplayTest : public testing::Test {
 protected:
  void SetUp() override {
    RegistryHooks hooks;
    hooks.store = &store_;
    registry_ = std::make_unique<MissionRegistry>(RegistryOptions{}, hooks);
    ASSERT_TRUE(registry_->Recover("hall").ok());
    host_ = *registry_->Find("hall");
    past_ = std::make_unique<PastMissions>(&store_, registry_.get());
    pool_ = std::make_unique<FairPool>(FairPoolOptions{.name = "past", .threads = 1});
  }
  std::shared_ptr<MapReplay> Replay(const ReplayWish& wish) {
    auto replay = std::make_shared<MapReplay>(
        MapReplay::Parts{host_, past_.get(), pool_.get(), {}, absl::ZeroDuration()}, wish);
    EXPECT_TRUE(replay->Begin(reader_, [this] { caught_up_.Notify(); }).ok());
    return replay;
  }
  static Frame Read(const MapFrames& frames) {
    Frame frame;
    EXPECT_TRUE(Parse(frames.messages.front(), frame).ok());
    return frame;
  }

  MemoryStore store_{/*is_durable=*/true};
  const PastRun run_ = StoreRun(store_);
  std::unique_ptr<MissionRegistry> registry_;
  std::shared_ptr<MissionHost> host_;
  std::unique_ptr<PastMissions> past_;
  absl::Notification caught_up_;
  const std::shared_ptr<Reader> reader_ = std::make_shared<Reader>();
  std::unique_ptr<FairPool> pool_;  // goes first: what it runs uses the above
};

TEST_F(MapReplayTest, FramesLeadFromThePastToNow) {
  const auto replay = Replay({.from_revision = 1, .speed_ratio = 1e6});
  auto frames = reader_->Next();
  ASSERT_NE(frames, nullptr) << reader_->end();
  EXPECT_EQ(Read(*frames).kind(), Frame::KIND_FULL);
  EXPECT_EQ(frames->revision, 1);
  while (frames->revision < run_.revision()) {
    const std::int64_t held = frames->revision;
    replay->Await();
    frames = reader_->Next();
    ASSERT_NE(frames, nullptr) << reader_->end();
    ASSERT_GT(frames->revision, held);
    ASSERT_EQ(Read(*frames).base_revision(), held);
  }
  replay->Await();
  caught_up_.WaitForNotification();
  EXPECT_TRUE(past_->Make(*host_, 1, "", PastUse::kReplay, NeverStop()).ok());  // its place is free
  replay->Stop();
}

TEST_F(MapReplayTest, NothingIsShownBeforeItsTime) {
  const auto replay = Replay({.from_revision = 2, .speed_ratio = 0.001});
  auto frames = reader_->Next();
  ASSERT_NE(frames, nullptr) << reader_->end();
  replay->Await();
  // The next scan was 0.1 s later, which is 100 s from now: what comes is at most of the same time.
  replay->Stop();
  EXPECT_FALSE(caught_up_.HasBeenNotified());
}

TEST_F(MapReplayTest, BeginningOfAMissionIsShownAtOnceWhateverItsTime) {
  const auto replay = Replay({.from_revision = 0, .speed_ratio = 0.001});
  auto frames = reader_->Next();
  ASSERT_NE(frames, nullptr) << reader_->end();
  EXPECT_EQ(frames->revision, 0);
  replay->Await();
  frames = reader_->Next();
  ASSERT_NE(frames, nullptr) << reader_->end();
  EXPECT_GE(frames->revision, 2);  // the registration, and the first scan
  replay->Stop();
}

TEST_F(MapReplayTest, WhatComesMeanwhileIsShownToo) {
  const auto replay = Replay({.from_revision = run_.revision(), .speed_ratio = 1e6});
  ASSERT_NE(reader_->Next(), nullptr) << reader_->end();
  const auto taken = store_.Acquire("hall");
  ASSERT_TRUE(taken.ok());
  ASSERT_TRUE(AddEvents(store_, "hall", taken->epoch,
                        {{run_.revision() + 1, RobotRegistered{"r2", 0.2, 9, 0}}})
                  .ok());
  replay->Await();
  const auto frames = reader_->Next();
  ASSERT_NE(frames, nullptr) << reader_->end();
  EXPECT_EQ(frames->revision, run_.revision() + 1);
  EXPECT_EQ(Read(*frames).status().robots_size(), 2);
  replay->Stop();
}

TEST_F(MapReplayTest, RevisionThatHasNotBeenEndsIt) {
  const auto replay = Replay({.from_revision = run_.revision() + 1});
  EXPECT_EQ(reader_->Next(), nullptr);
  EXPECT_THAT(reader_->end(), IsNotYet("from_revision"));
  replay->Stop();
}

TEST_F(MapReplayTest, EventThatCannotBeAppliedEndsIt) {
  const auto taken = store_.Acquire("hall");
  ASSERT_TRUE(taken.ok());
  ASSERT_TRUE(
      AddEvents(store_, "hall", taken->epoch, {{run_.revision() + 1, RobotRemoved{"nobody"}}})
          .ok());
  const auto replay = Replay({.from_revision = run_.revision(), .speed_ratio = 1e6});
  ASSERT_NE(reader_->Next(), nullptr) << reader_->end();
  replay->Await();
  EXPECT_EQ(reader_->Next(), nullptr);
  EXPECT_TRUE(absl::IsDataLoss(reader_->end())) << reader_->end();
  replay->Stop();
}

}  // namespace map_replay_test
}  // namespace plumescout::server
