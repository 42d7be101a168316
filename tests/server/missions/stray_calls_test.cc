// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/stray_calls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/server/captured_log.h"
#include "tests/server/fake_nodes.h"

namespace plumescout::server {
namespace stray_calls_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(StrayCallsTest, TheStoreIsToldOnceOfEachMissionWhoseCallsStrayed) {
  SharedStore store;
  StrayCalls strays(&store, [](const StrayMission&) { return absl::OkStatus(); });
  for (const char* key : {"hall", "acme/yard", "hall"}) strays.Note({key, "n2"});
  EXPECT_THAT(store.noted_strays(), ElementsAre()) << "not by calls";
  strays.Follow();
  strays.Follow();
  EXPECT_THAT(store.noted_strays(),
              ElementsAre(OwnedMission{"acme/yard", "n2"}, OwnedMission{"hall", "n2"}));
  EXPECT_EQ(strays.figures().calls, 3);
}

TEST(StrayCallsTest, MissionsThatOthersToldOfAreGivenUp) {
  SharedStore store;
  std::vector<std::string> given;
  StrayCalls strays(&store, [&](const StrayMission& mission) {
    given.push_back(mission.key + " to " + mission.came_to);
    return mission.key == "hall" ? absl::AbortedError("it is being read") : absl::OkStatus();
  });
  store.SetStrays({{{"hall", 1, "n2"}, {"yard", 4, "n3"}}, {"n1"}});
  const std::string log = LogOf([&] {
    strays.Follow();
    strays.Follow();
  });
  EXPECT_THAT(given, ElementsAre("hall to n2", "yard to n3"));
  EXPECT_EQ(strays.figures().given_up, 1);
  EXPECT_THAT(strays.figures().unreached, ElementsAre("n1"));
  EXPECT_THAT(log, HasSubstr("calls do not reach nodes nodes=n1"));
  EXPECT_THAT(log, HasSubstr("it is being read"));
}

TEST(StrayCallsTest, AServerThatIsAloneFollowsNone) {
  StrayCalls strays(nullptr, [](const StrayMission&) { return absl::OkStatus(); });
  strays.Note({"hall", "n2"});
  strays.Follow();
  EXPECT_EQ(strays.figures().given_up, 0);
}

}  // namespace stray_calls_test
}  // namespace plumescout::server
