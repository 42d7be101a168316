// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_watch.h"

#include <gtest/gtest.h>

#include "absl/synchronization/notification.h"
#include "tests/server/held_store.h"

namespace plumescout::server {
namespace store_watch_test {

TEST(StoreWatchTest, TellsOfEachChangeOnce) {
  HeldStore store;
  absl::Notification failed;
  absl::Notification recovered;
  const StoreWatch watch(&store, absl::Milliseconds(1), [&](bool available) {
    (available ? recovered : failed).Notify();  // twice would be an error of its own
  });
  store.set_state(Refusing("disk full"));
  failed.WaitForNotification();
  EXPECT_FALSE(recovered.HasBeenNotified());
  store.set_state({});
  recovered.WaitForNotification();
}

}  // namespace store_watch_test
}  // namespace plumescout::server
