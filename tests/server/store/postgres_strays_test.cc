// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_strays.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/server/store/shared_work.h"

namespace plumescout::server {
namespace postgres_strays_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class PostgresStraysTest : public ::testing::Test {
 protected:
  PostgresStraysTest() {
    for (const char* key : {"hall", "mill"}) EXPECT_TRUE(first_->Create(key, "").ok());
  }
  static constexpr StrayRules kRules = {};

  void Note(const std::string& key, const std::string& node = "n1") {
    ASSERT_TRUE(second_->nodes()->NoteStrays({{key, node}}).ok());
  }
  // As if all that was noted had been noted so much earlier.
  void Pass(absl::Duration time) {
    PostgresServer::Shared().Ask(
        url_, absl::StrCat("UPDATE plumescout_stray SET since = since - interval '",
                           absl::ToInt64Seconds(time), " s', seen = seen - interval '",
                           absl::ToInt64Seconds(time), " s'"));
  }
  std::vector<StrayMission> Take(PostgresStore& store) {
    return store.nodes()->TakeStrays(9).value().missions;
  }
  std::vector<std::string> Unreached() { return second_->nodes()->TakeStrays(9).value().unreached; }

  const std::string url_ = PostgresServer::Shared().NewUrl();
  std::unique_ptr<PostgresStore> first_ = OpenShared(url_, "n1");
  const std::unique_ptr<PostgresStore> second_ = OpenShared(url_, "n2");
};

TEST_F(PostgresStraysTest, WhoHasAMissionHearsOfItOnceCallsHaveStrayedForLongEnough) {
  Note("hall");
  EXPECT_THAT(Unreached(), ElementsAre("n1"));
  EXPECT_THAT(Take(*first_), IsEmpty()) << "one call";
  Pass(kRules.lasts);
  EXPECT_THAT(Take(*first_), IsEmpty()) << "none since";
  Note("hall");
  EXPECT_THAT(Take(*second_), IsEmpty()) << "it is not its own";
  EXPECT_THAT(Take(*first_), ElementsAre(StrayMission{"hall", 1, "n2"}));
  Note("hall");
  EXPECT_THAT(Take(*first_), IsEmpty()) << "it was told";
}

TEST_F(PostgresStraysTest, CallsThatStrayNowAndThenAreNotEnough) {
  for (int i = 0; i < 3; ++i) {
    Note("hall");
    Pass(kRules.gap + absl::Seconds(1));
  }
  Note("hall");
  EXPECT_THAT(Take(*first_), IsEmpty());
  Pass(kRules.lasts);
  Note("hall");
  Pass(kRules.gap + absl::Seconds(1));
  EXPECT_THAT(Take(*first_), IsEmpty()) << "they reach it again";
}

TEST_F(PostgresStraysTest, OnlyWhatTheNamedNodeHasCounts) {
  Note("hall", "n3");
  Note("attic");
  EXPECT_THAT(Unreached(), IsEmpty());
  Note("mill");
  Pass(kRules.lasts);
  ASSERT_TRUE(first_->nodes()->Release("mill", 1).ok());
  ASSERT_EQ(second_->Acquire("mill")->epoch, 2);
  Note("mill");
  EXPECT_THAT(Take(*first_), IsEmpty());
  EXPECT_THAT(Take(*second_), IsEmpty());
  ExpireLease(url_, "n1");
  EXPECT_THAT(Unreached(), IsEmpty()) << "it does not live";
}

TEST_F(PostgresStraysTest, WhatHasMovedRestsAtItsNewNode) {
  Note("hall");
  Pass(kRules.lasts);
  Note("hall");
  ASSERT_EQ(Take(*first_).size(), 1u);
  ASSERT_TRUE(first_->nodes()->Release("hall", 1).ok());
  ASSERT_EQ(second_->Acquire("hall")->epoch, 2);
  const auto stray_again = [this] {
    ASSERT_TRUE(first_->nodes()->NoteStrays({{"hall", "n2"}}).ok());
    Pass(kRules.lasts);
    ASSERT_TRUE(first_->nodes()->NoteStrays({{"hall", "n2"}}).ok());
  };
  stray_again();
  EXPECT_THAT(Take(*second_), IsEmpty());
  Pass(kRules.rests);
  stray_again();
  EXPECT_THAT(Take(*second_), ElementsAre(StrayMission{"hall", 2, "n1"}));
}

TEST_F(PostgresStraysTest, WhatIsOverIsForgotten) {
  Note("hall");
  Pass(kRules.shown + absl::Seconds(1));
  EXPECT_THAT(Unreached(), IsEmpty());
  EXPECT_EQ(PostgresServer::Shared().Ask(url_, "SELECT count(*) FROM plumescout_stray"), "0");
}

}  // namespace postgres_strays_test
}  // namespace plumescout::server
