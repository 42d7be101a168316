// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_reaper.h"

#include <gtest/gtest.h>

#include <memory>

#include "absl/synchronization/notification.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace mission_reaper_test {

// A mission whose writer is busy until then; the host may be gone by then.
std::shared_ptr<MissionHost> BusyUntil(const absl::Notification& release) {
  auto host = std::make_shared<MissionHost>(HostParts(), HostOptions{});
  absl::Notification busy;
  EXPECT_TRUE(host->Post([&](MissionWriter&) {
                    busy.Notify();
                    release.WaitForNotification();
                  })
                  .ok());
  busy.WaitForNotification();
  return host;
}

TEST(MissionReaperTest, WaitsForMissionsInPlaceOfTheCaller) {
  absl::Notification release;
  absl::Notification stopped;
  MissionReaper reaper;
  reaper.Take(BusyUntil(release), absl::NotFoundError("deleted"), [&] { stopped.Notify(); });
  EXPECT_FALSE(reaper.AwaitAll(SteadyNow()));
  EXPECT_FALSE(stopped.HasBeenNotified());
  release.Notify();
  EXPECT_TRUE(reaper.AwaitAll(SteadyTime::max()));
  EXPECT_TRUE(stopped.HasBeenNotified());
}

TEST(MissionReaperTest, MissionTakesNothingMoreThoughAnotherHoldsUpTheReaper) {
  absl::Notification release;
  MissionReaper reaper;
  reaper.Take(BusyUntil(release), absl::NotFoundError("deleted"));
  const auto host = std::make_shared<MissionHost>(HostParts(), HostOptions{});
  reaper.Take(host, absl::NotFoundError("deleted"));
  EXPECT_TRUE(absl::IsNotFound(host->Post([](MissionWriter&) {})));
  release.Notify();
}

TEST(MissionReaperTest, EndsWithAllThatItTook) {
  absl::Notification release;
  bool stopped = false;
  {
    MissionReaper reaper;
    reaper.Take(BusyUntil(release), absl::NotFoundError("deleted"), [&] { stopped = true; });
    release.Notify();
  }
  EXPECT_TRUE(stopped);
}

TEST(MissionReaperTest, NothingToWaitForIsNoWait) {
  MissionReaper reaper;
  EXPECT_TRUE(reaper.AwaitAll(SteadyNow()));
}

}  // namespace mission_reaper_test
}  // namespace plumescout::server
