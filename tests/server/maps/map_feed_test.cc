// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/map_feed.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"
#include "absl/time/time.h"
#include "tests/server/maps/map_replica.h"
#include "tests/server/maps/random_map.h"

namespace plumescout::server {
namespace map_feed_test {

using BeliefPtr = std::shared_ptr<const Belief>;

constexpr absl::Duration kPatience = absl::Seconds(60);

// Tells subscribers of beliefs as a mission's host does.
class Mission {
 public:
  absl::Status Subscribe(const MapFeed::Subscriber& subscriber) {
    if (!refusal_.ok()) return refusal_;
    if (subscriber(present_)) subscribers_.push_back(subscriber);
    return absl::OkStatus();
  }
  void Publish(absl::StatusOr<BeliefPtr> belief) {
    if (belief.ok()) present_ = *belief;
    std::erase_if(subscribers_, [&](const auto& subscriber) { return !subscriber(belief); });
  }
  void Refuse(absl::Status status) { refusal_ = std::move(status); }
  std::size_t subscriber_count() const { return subscribers_.size(); }

 private:
  absl::Status refusal_;
  BeliefPtr present_;
  std::vector<MapFeed::Subscriber> subscribers_;
};

// Follows the map; asks for more at once, or when it is told to.
class Watcher final : public MapReader, public std::enable_shared_from_this<Watcher> {
 public:
  explicit Watcher(MapFeed* feed, bool is_slow = false) : feed_(feed), is_slow_(is_slow) {}

  void Take(std::shared_ptr<const MapFrames> frames) override {
    {
      absl::MutexLock lock(&mutex_);
      replica_.Apply(*frames);
      ++taken_;
    }
    if (!is_slow_) feed_->Await(this);
  }
  void End(const absl::Status& status) override {
    absl::MutexLock lock(&mutex_);
    end_ = status;
    ended_ = true;
  }

  bool AwaitRevision(std::int64_t revision) {
    absl::MutexLock lock(&mutex_);
    const auto has = [&] { return replica_.revision() >= revision; };
    return mutex_.AwaitWithTimeout(absl::Condition(&has), kPatience);
  }
  int taken() {
    absl::MutexLock lock(&mutex_);
    return taken_;
  }
  bool ended() {
    absl::MutexLock lock(&mutex_);
    return ended_;
  }
  absl::Status end() {
    absl::MutexLock lock(&mutex_);
    return end_;
  }
  Grid<CellState> states() {
    absl::MutexLock lock(&mutex_);
    return replica_.map().occupancy;
  }

 private:
  MapFeed* const feed_;
  const bool is_slow_;
  absl::Mutex mutex_;
  MapReplica replica_;
  int taken_ = 0;
  bool ended_ = false;
  absl::Status end_;
};

// Occupies the only thread of a pool, and all of its queue.
class Stall {
 public:
  explicit Stall(WorkerPool* pool) {
    EXPECT_TRUE(pool->Submit([this] {
                      occupied_.Notify();
                      release_.WaitForNotification();
                    })
                    .ok());
    occupied_.WaitForNotification();
    while (pool->Submit([] {}).ok()) {
    }
  }
  ~Stall() { Release(); }
  void Release() {
    if (!release_.HasBeenNotified()) release_.Notify();
  }

 private:
  absl::Notification occupied_;
  absl::Notification release_;
};

class MapFeedTest : public testing::Test {
 protected:
  MapFeedTest() : map_(MakeRandomMap({0.0, 0.0, 0.1, 128, 128}, rng_)) { Publish(); }

  std::shared_ptr<Watcher> Join(bool is_slow = false, const MapView& view = {}) {
    auto watcher = std::make_shared<Watcher>(feed_.get(), is_slow);
    EXPECT_TRUE(TryToJoin(watcher, view).ok());
    return watcher;
  }
  absl::Status TryToJoin(const std::shared_ptr<Watcher>& watcher, const MapView& view = {}) {
    return feed_->Join(watcher, view, &pool_, [this](const MapFeed::Subscriber& subscriber) {
      return mission_.Subscribe(subscriber);
    });
  }
  // A belief with a cell more that is occupied; returns its revision.
  std::int64_t Publish() {
    map_.states[static_cast<std::size_t>(++revision_)] = CellState::kOccupied;
    mission_.Publish(BeliefOf(revision_, map_));
    return revision_;
  }
  void WaitUntilServed() {
    absl::Notification done;
    while (!pool_.Submit([&] { done.Notify(); }).ok()) {
    }
    done.WaitForNotification();
  }

  Rng rng_{1};
  RandomMap map_;
  std::int64_t revision_ = 0;
  Mission mission_;
  std::shared_ptr<MapFeed> feed_ = std::make_shared<MapFeed>("hall", 1 << 24);
  WorkerPool pool_{{"map", 1, 2}};
};

TEST_F(MapFeedTest, HundredWatchersCostOneEncoding) {
  constexpr int kWatchers = 100;
  constexpr int kBeliefs = 5;
  std::vector<std::shared_ptr<Watcher>> watchers;
  for (int i = 0; i < kWatchers; ++i) watchers.push_back(Join());
  for (const auto& watcher : watchers) ASSERT_TRUE(watcher->AwaitRevision(1));
  for (int i = 0; i < kBeliefs; ++i) {
    Publish();
    for (const auto& watcher : watchers) ASSERT_TRUE(watcher->AwaitRevision(revision_));
  }
  for (const auto& watcher : watchers) {
    EXPECT_EQ(watcher->taken(), 1 + kBeliefs);
    EXPECT_EQ(watcher->states(), map_.states);
  }
  const MapStoreCounts counts = feed_->store().counts();
  EXPECT_EQ(counts.revisions, 1 + kBeliefs);
  EXPECT_EQ(counts.frames, 1 + kBeliefs);
  EXPECT_LE(counts.tiles, 12 + kBeliefs);  // one tile of occupancy changes
  EXPECT_EQ(mission_.subscriber_count(), 1u);
  EXPECT_EQ(feed_->reader_count(), kWatchers);
}

TEST_F(MapFeedTest, FullPoolEndsNoWatcher) {
  const auto watcher = Join();
  ASSERT_TRUE(watcher->AwaitRevision(1));
  Stall stall(&pool_);
  for (int i = 0; i < 10; ++i) Publish();
  EXPECT_FALSE(watcher->ended());
  stall.Release();
  WaitUntilServed();
  EXPECT_EQ(watcher->taken(), 1);
  Publish();
  ASSERT_TRUE(watcher->AwaitRevision(revision_));
  EXPECT_EQ(watcher->taken(), 2);
  EXPECT_EQ(watcher->states(), map_.states);
}

TEST_F(MapFeedTest, StalledPoolIsWaitedFor) {
  absl::Notification occupied;
  absl::Notification release;
  const auto watcher = Join();
  ASSERT_TRUE(watcher->AwaitRevision(1));
  ASSERT_TRUE(pool_
                  .Submit([&] {
                    occupied.Notify();
                    release.WaitForNotification();
                  })
                  .ok());
  occupied.WaitForNotification();
  for (int i = 0; i < 10; ++i) Publish();
  EXPECT_TRUE(pool_.Submit([] {}).ok()) << "all beliefs take one place in the queue";
  release.Notify();
  ASSERT_TRUE(watcher->AwaitRevision(revision_));
  EXPECT_EQ(watcher->taken(), 2);
}

TEST_F(MapFeedTest, SlowWatcherGetsTheNewestWhenItAsks) {
  const auto slow = Join(/*is_slow=*/true);
  const auto quick = Join();
  ASSERT_TRUE(slow->AwaitRevision(1));
  for (int i = 0; i < 20; ++i) {
    Publish();
    ASSERT_TRUE(quick->AwaitRevision(revision_));
  }
  EXPECT_EQ(slow->taken(), 1);
  feed_->Await(slow.get());
  ASSERT_TRUE(slow->AwaitRevision(revision_));
  EXPECT_EQ(slow->taken(), 2);
  EXPECT_EQ(slow->states(), map_.states);
  feed_->Await(slow.get());
  WaitUntilServed();
  EXPECT_EQ(slow->taken(), 2) << "there is nothing new";
}

TEST_F(MapFeedTest, MissionIsLeftAloneWhenNobodyWatches) {
  const auto first = Join();
  const auto second = Join();
  ASSERT_TRUE(first->AwaitRevision(1));
  ASSERT_TRUE(second->AwaitRevision(1));
  feed_->Leave(first.get());
  Publish();
  EXPECT_EQ(mission_.subscriber_count(), 1u);
  ASSERT_TRUE(second->AwaitRevision(revision_));
  EXPECT_EQ(first->taken(), 1);
  feed_->Leave(second.get());
  EXPECT_EQ(feed_->reader_count(), 0);
  Publish();
  EXPECT_EQ(mission_.subscriber_count(), 0u);
  const auto third = Join();
  EXPECT_TRUE(third->AwaitRevision(revision_));
  EXPECT_EQ(mission_.subscriber_count(), 1u);
}

TEST_F(MapFeedTest, WatcherOfAnotherViewIsServedTheSame) {
  const auto coarse = Join(false, {.level_of_detail = 3});
  Publish();
  ASSERT_TRUE(coarse->AwaitRevision(revision_));
  EXPECT_EQ(coarse->states().width(), 16);
}

TEST_F(MapFeedTest, EndOfTheMissionEndsAllWatchers) {
  const auto watcher = Join();
  const auto other = Join();
  mission_.Publish(absl::NotFoundError("gone"));
  EXPECT_TRUE(absl::IsNotFound(watcher->end()));
  EXPECT_TRUE(absl::IsNotFound(other->end()));
  EXPECT_EQ(mission_.subscriber_count(), 0u);
}

TEST_F(MapFeedTest, WhoIsRefusedByTheMissionDoesNotJoin) {
  mission_.Refuse(absl::ResourceExhaustedError("full"));
  const auto refused = std::make_shared<Watcher>(feed_.get());
  EXPECT_TRUE(absl::IsResourceExhausted(TryToJoin(refused)));
  mission_.Refuse(absl::OkStatus());
  const auto watcher = Join();
  ASSERT_TRUE(watcher->AwaitRevision(revision_));
  Publish();
  ASSERT_TRUE(watcher->AwaitRevision(revision_));
  EXPECT_EQ(refused->taken(), 0);
}

}  // namespace map_feed_test
}  // namespace plumescout::server
