// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/ingest_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

namespace plumescout::server {
namespace ingest_room_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class IngestRoomTest : public testing::Test {
 protected:
  // Notes `name` when there is room, and keeps it.
  IngestRoom::Place Wait(int name, const IngestLoad& load) {
    return room_->TakeOrWait(load, [this, name](IngestRoom::Hold hold) {
      granted_.push_back(name);
      holds_.push_back(std::move(hold));
    });
  }

  const std::shared_ptr<IngestRoom> room_ = std::make_shared<IngestRoom>(IngestLoad{10, 1000});
  std::vector<int> granted_;
  std::vector<IngestRoom::Hold> holds_;
};

TEST_F(IngestRoomTest, RoomIsBoundedInObservationsAndInBytes) {
  auto first = room_->TryTake({6, 100});
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(room_->TryTake({5, 100}), nullptr);
  EXPECT_EQ(room_->TryTake({1, 901}), nullptr);
  const auto second = room_->TryTake({4, 900});
  EXPECT_NE(second, nullptr);
  EXPECT_EQ(room_->used().observations, 10);
  EXPECT_EQ(room_->used().bytes, 1000);
  first = nullptr;
  EXPECT_EQ(room_->used().observations, 4);
  EXPECT_NE(room_->TryTake({6, 100}), nullptr);
}

TEST_F(IngestRoomTest, WhoWaitsGetsRoomInTheOrderOfAsking) {
  auto all = room_->TryTake({10, 10});
  for (int name = 1; name <= 3; ++name) Wait(name, {4, 10});
  EXPECT_THAT(granted_, IsEmpty());
  EXPECT_EQ(room_->waiting(), 3);
  all = nullptr;
  EXPECT_THAT(granted_, ElementsAre(1, 2));
  EXPECT_EQ(room_->TryTake({1, 1}), nullptr) << "somebody waits";
  holds_[0] = nullptr;
  EXPECT_THAT(granted_, ElementsAre(1, 2, 3));
}

TEST_F(IngestRoomTest, WhoFindsRoomDoesNotWait) {
  Wait(1, {4, 10});
  EXPECT_THAT(granted_, ElementsAre(1));
}

TEST_F(IngestRoomTest, WithdrawnPlacesHoldNobodyUp) {
  auto all = room_->TryTake({8, 10});
  const IngestRoom::Place place = Wait(1, {4, 10});
  Wait(2, {2, 10});
  EXPECT_THAT(granted_, IsEmpty());
  room_->Withdraw(place);
  EXPECT_THAT(granted_, ElementsAre(2));
  all = nullptr;
  EXPECT_THAT(granted_, ElementsAre(2));
}

TEST_F(IngestRoomTest, RoomThatNobodyKeepsGoesToTheNext) {
  auto all = room_->TryTake({10, 10});
  for (int i = 0; i < 3; ++i) room_->TakeOrWait({10, 10}, [](const IngestRoom::Hold&) {});
  Wait(4, {10, 10});
  all = nullptr;
  EXPECT_THAT(granted_, ElementsAre(4));
}

TEST_F(IngestRoomTest, BatchLargerThanTheRoomGetsItWhenItIsEmpty) {
  auto one = room_->TryTake({1, 1});
  EXPECT_EQ(room_->TryTake({11, 2000}), nullptr);
  one = nullptr;
  EXPECT_NE(room_->TryTake({11, 2000}), nullptr);
}

TEST_F(IngestRoomTest, HoldsOutliveTheRoom) {
  auto room = std::make_shared<IngestRoom>(IngestLoad{1, 1});
  auto hold = room->TryTake({1, 1});
  room = nullptr;
  hold = nullptr;
}

TEST(IngestLoadTest, BytesAreThoseOfRangesAndEntries) {
  std::vector<IncomingObservation> batch(2);
  batch[0].observation.payload = GasReading{1.0, 0.0};
  batch[1].observation.payload = Scan{0.0, 0.1, 10.0, std::vector<float>(1000, 1.0f)};
  const IngestLoad load = LoadOf(batch);
  EXPECT_EQ(load.observations, 2);
  EXPECT_GE(load.bytes, 4000 + 2 * static_cast<std::int64_t>(sizeof(Observation)));
  EXPECT_LE(load.bytes, 5000);
}

}  // namespace ingest_room_test
}  // namespace plumescout::server
