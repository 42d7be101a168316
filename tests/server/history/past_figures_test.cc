// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/past_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/synchronization/notification.h"
#include "tests/server/history/past_run.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace past_figures_test {

class PastFiguresTest : public testing::Test {
 protected:
  void SetUp() override {
    StoreRun(store_, "attic");
    RegistryHooks hooks;
    hooks.store = &store_;
    registry_ = std::make_unique<MissionRegistry>(RegistryOptions{}, hooks);
    past_ = std::make_unique<PastMissions>(&store_, registry_.get());
    figures_ = std::make_unique<PastFigures>(past_.get());
    pool_ = std::make_unique<FairPool>(FairPoolOptions{.name = "past", .threads = 1});
  }
  std::shared_ptr<MissionHost> Host(const std::string& id) {
    EXPECT_TRUE(registry_->Recover(id).ok());
    return *registry_->Find(id);
  }
  v1::GetMissionFiguresResponse AskUntilDone(const std::shared_ptr<MissionHost>& host) {
    auto answer = figures_->Ask(host, {pool_.get()});
    while (answer.ok() && answer->more_follow()) {
      absl::Notification ran;
      EXPECT_TRUE(pool_->Submit({}, {[&] { ran.Notify(); }}).ok());
      ran.WaitForNotification();
      answer = figures_->Ask(host, {pool_.get()});
    }
    EXPECT_TRUE(answer.ok()) << answer.status();
    return answer.ok() ? *std::move(answer) : v1::GetMissionFiguresResponse();
  }

  MemoryStore store_{/*is_durable=*/true};
  const PastRun run_ = StoreRun(store_);
  std::unique_ptr<MissionRegistry> registry_;
  std::unique_ptr<PastMissions> past_;
  std::unique_ptr<PastFigures> figures_;
  std::unique_ptr<FairPool> pool_;  // goes first: what it runs uses the above
};

TEST_F(PastFiguresTest, EveryMissionHasItsOwnAndTheyAreKept) {
  const auto hall = Host("hall"), attic = Host("attic");
  const auto of_hall = AskUntilDone(hall);
  const auto of_attic = AskUntilDone(attic);
  ASSERT_GT(of_hall.figures_size(), 0);
  EXPECT_EQ(of_hall.figures(0).robots(0).robot(), "missions/hall/robots/r1");
  EXPECT_EQ(of_attic.figures(0).robots(0).robot(), "missions/attic/robots/r1");
  const int reads = store_.read_count();
  EXPECT_EQ(AskUntilDone(hall).SerializeAsString(), of_hall.SerializeAsString());
  EXPECT_EQ(store_.read_count(), reads);
}

}  // namespace past_figures_test
}  // namespace plumescout::server
