// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/end_listeners.h"

#include <gtest/gtest.h>

namespace plumescout::server {
namespace end_listeners_test {

class EndListenersTest : public testing::Test {
 protected:
  EndListeners::Id Listen() {
    return listeners_.Add([this](const absl::Status& status) {
      ++told_;
      end_ = status;
    });
  }

  EndListeners listeners_;
  int told_ = 0;
  absl::Status end_;
};

TEST_F(EndListenersTest, AllHearOfTheEndOnce) {
  Listen();
  Listen();
  EXPECT_EQ(told_, 0);
  listeners_.End(absl::UnavailableError("over"));
  listeners_.End(absl::NotFoundError("over again"));
  EXPECT_EQ(told_, 2);
  EXPECT_TRUE(absl::IsUnavailable(end_));
  EXPECT_EQ(listeners_.size(), 0);
}

TEST_F(EndListenersTest, WhoLeftHearsNothing) {
  const EndListeners::Id id = Listen();
  EXPECT_NE(id, 0);
  listeners_.Remove(id);
  listeners_.Remove(id);
  listeners_.End(absl::UnavailableError("over"));
  EXPECT_EQ(told_, 0);
}

TEST_F(EndListenersTest, WhoComesTooLateHearsAtOnce) {
  listeners_.End(absl::UnavailableError("over"));
  EXPECT_EQ(Listen(), 0);
  EXPECT_EQ(told_, 1);
  EXPECT_TRUE(absl::IsUnavailable(end_));
}

}  // namespace end_listeners_test
}  // namespace plumescout::server
