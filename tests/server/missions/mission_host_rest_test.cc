// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission host: a mission that comes to rest.
#include <gtest/gtest.h>

#include "absl/synchronization/notification.h"
#include "server/missions/mission_host.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace mission_host_rest_test {

TEST(MissionHostRestTest, AMissionThatRestsKeepsWhatIsPostedUntilItEnds) {
  absl::Notification rests;
  absl::Status end;
  MissionHost host(HostParts(), {});
  ASSERT_TRUE(host.Post([](MissionWriter& writer) {
                    EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, 7}).ok());
                  })
                  .ok());
  ASSERT_TRUE(host.BeginRest([&](const absl::Status& status) {
                    EXPECT_TRUE(status.ok()) << status;
                    rests.Notify();
                  })
                  .ok());
  rests.WaitForNotification();
  EXPECT_EQ(host.summary().revision, 1) << "what came before is done";
  ASSERT_TRUE(host.Post([](MissionWriter&) { ADD_FAILURE() << "it rests"; },
                        [&](const absl::Status& status) { end = status; })
                  .ok());
  EXPECT_EQ(host.load().queued_commands, 1);
  host.Stop(absl::UnavailableError("it is elsewhere"));
  EXPECT_TRUE(absl::IsUnavailable(end));
}

TEST(MissionHostRestTest, WhoWaitsForItsRestHearsThatItEndsBefore) {
  absl::Notification go;
  absl::Status end;
  MissionHost host(HostParts(), {});
  ASSERT_TRUE(host.Post([&](MissionWriter&) { go.WaitForNotification(); }).ok());
  ASSERT_TRUE(host.BeginRest([&](const absl::Status& status) { end = status; }).ok());
  host.BeginStop(absl::UnavailableError("over"));
  host.DropAll();
  EXPECT_TRUE(absl::IsUnavailable(end));
  go.Notify();
}

}  // namespace mission_host_rest_test
}  // namespace plumescout::server
