// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/past_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/maps/map_feed.h"
#include "server/maps/map_store.h"
#include "server/maps/wire_message.h"
#include "tests/server/history/past_run.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace past_maps_test {

class PastMapsTest : public testing::Test {
 protected:
  void SetUp() override {
    RegistryHooks hooks;
    hooks.store = &store_;
    registry_ = std::make_unique<MissionRegistry>(RegistryOptions{}, hooks);
    ASSERT_TRUE(registry_->Recover("hall").ok());
    host_ = *registry_->Find("hall");
    past_ = std::make_unique<PastMissions>(&store_, registry_.get());
    maps_ = std::make_unique<PastMaps>(past_.get());
  }
  absl::StatusOr<v1::GetMapResponse> Get(const PastMapWish& wish) {
    const auto bytes = maps_->Part(host_, wish, NeverStop());
    if (!bytes.ok()) return bytes.status();
    v1::GetMapResponse response;
    EXPECT_TRUE(Parse(*bytes, response).ok());
    return response;
  }
  // What a reader was told when the mission was there.
  v1::GetMapResponse AsItWas(std::int64_t revision) {
    Mission mission{MissionOptions{}};
    for (std::int64_t i = 0; i < revision; ++i) {
      EXPECT_TRUE(mission.Apply(run_.events[static_cast<std::size_t>(i)].body).ok());
    }
    MapStore store("hall", host_->map_feed()->store().max_part_bytes());
    v1::GetMapResponse response;
    EXPECT_TRUE(Parse(store.FirstPart(*mission.Snapshot(), {}, 0), response).ok());
    return response;
  }

  MemoryStore store_{/*is_durable=*/true};
  const PastRun run_ = StoreRun(store_);
  std::unique_ptr<MissionRegistry> registry_;
  std::shared_ptr<MissionHost> host_;
  std::unique_ptr<PastMissions> past_;
  std::unique_ptr<PastMaps> maps_;
};

TEST_F(PastMapsTest, MapIsWhatReadersWereToldThen) {
  for (const std::int64_t revision : {std::int64_t{1}, std::int64_t{60}, run_.revision()}) {
    const auto map = Get({.revision = revision});
    ASSERT_TRUE(map.ok()) << map.status();
    EXPECT_EQ(map->revision(), revision);
    EXPECT_TRUE(map->SerializeAsString() == AsItWas(revision).SerializeAsString()) << revision;
  }
}

TEST_F(PastMapsTest, PartsMakeTheMapThoughOthersAreLookedAt) {
  const auto whole = Get({.revision = 60});
  ASSERT_TRUE(whole.ok()) << whole.status();
  PastMapWish wish{.revision = 60, .max_bytes = 1};
  auto part = Get(wish);
  ASSERT_TRUE(part.ok()) << part.status();
  v1::GetMapResponse together = *part;
  for (std::int64_t other = 1; !part->next_part_token().empty(); ++other) {
    ASSERT_TRUE(Get({.revision = other}).ok());  // takes the place of what is kept
    wish.part_token = part->next_part_token();
    part = Get(wish);
    ASSERT_TRUE(part.ok()) << part.status();
    together.mutable_tiles()->MergeFrom(part->tiles());
  }
  together.clear_next_part_token();
  EXPECT_GT(together.tiles_size(), 1);
  EXPECT_TRUE(together.SerializeAsString() == whole->SerializeAsString());
}

TEST_F(PastMapsTest, BeliefIsKeptForWhoeverAsksNext) {
  const auto first = maps_->BeliefAt(host_, 60, NeverStop());
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_EQ((*first)->revision, 60);
  ASSERT_TRUE(Get({.revision = 60, .view = {.level_of_detail = 1}}).ok());
  EXPECT_EQ(*maps_->BeliefAt(host_, 60, NeverStop()), *first);
  ASSERT_TRUE(Get({.revision = 61}).ok());
  const auto map = maps_->BeliefAt(host_, 61, NeverStop());
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ((*map)->revision, 61);
  EXPECT_THAT(maps_->BeliefAt(host_, run_.revision() + 1, NeverStop()).status(),
              IsNotYet("revision"));
}

TEST_F(PastMapsTest, TokensAreOfTheirMap) {
  const auto part = Get({.revision = 60, .max_bytes = 1});
  ASSERT_TRUE(part.ok()) << part.status();
  const std::string token = part->next_part_token();
  EXPECT_THAT(Get({.revision = 61, .part_token = token}).status(), Blames("part_token"));
  EXPECT_THAT(Get({.revision = 60, .view = {.level_of_detail = 1}, .part_token = token}).status(),
              Blames("part_token"));
  EXPECT_THAT(Get({.revision = run_.revision() + 1}).status(), IsNotYet("revision"));
}

}  // namespace past_maps_test
}  // namespace plumescout::server
