// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/store_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/types/error_reason.h"

namespace plumescout::server {
namespace store_errors_test {

using ::testing::HasSubstr;

TEST(StoreErrors, HaveReasonsThatProgramsActOn) {
  EXPECT_EQ(ErrorReason(NotStored("a")), reason::kMissionNotFound);
  EXPECT_EQ(ErrorReason(AlreadyStored("a")), reason::kMissionExists);
  EXPECT_EQ(ErrorReason(FencedByEpoch("a", 1, 2)), reason::kFenced);
  EXPECT_EQ(ErrorReason(FencedByHead("a", 1, 2)), reason::kFenced);
  EXPECT_EQ(ErrorReason(StoreDamaged("file")), reason::kStoreDamaged);
  EXPECT_EQ(ErrorReason(StoreUnavailable("file")), reason::kStoreUnavailable);
}

TEST(StoreErrors, NameTheMissionInPrintableWords) {
  EXPECT_THAT(std::string(NotStored("a\n").message()), HasSubstr("mission a\\n"));
  EXPECT_THAT(std::string(FencedByHead("team/a", 9, 7).message()),
              HasSubstr("mission team/a has record 7 last, so 9 is not the next one"));
  EXPECT_THAT(std::string(SnapshotAhead("a", 9, 7).message()), HasSubstr("revision 9"));
  EXPECT_THAT(std::string(BadFirstNumber(-3).message()), HasSubstr("-3"));
}

TEST(StoreErrors, NameTheNodeThatHasTheMission) {
  EXPECT_EQ(NodeElsewhere(MissionElsewhere("a", "n2")), "n2");
  EXPECT_EQ(NodeElsewhere(FencedByEpoch("a", 1, 2)), "");
  EXPECT_EQ(NodeElsewhere(absl::OkStatus()), "");
  for (const char* key : {"a", "team/a", "a is served by node n3\n"}) {
    EXPECT_EQ(KeyElsewhere(MissionElsewhere(key, "n2")), key);
  }
  EXPECT_EQ(KeyElsewhere(FencedByEpoch("a", 1, 2)), "");
}

}  // namespace store_errors_test
}  // namespace plumescout::server
