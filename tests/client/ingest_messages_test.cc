// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ingest_messages.h"

#include <gtest/gtest.h>

namespace plumescout::client {
namespace ingest_messages_test {

TEST(IngestMessagesTest, AStateIsReadWhole) {
  v1::IngestState proto;
  proto.set_applied_sequence(5);
  proto.set_durable_sequence(3);
  proto.set_credit_sequence(90);
  proto.set_revision(7);
  EXPECT_EQ(StateFromProto(proto), (IngestState{5, 3, 90, 7}));
}

TEST(IngestMessagesTest, AnOpeningSaysWhoseLogItIsAndHowMuchWasSafe) {
  RobotSession session;
  session.mission = "house";
  session.robot = "scout";
  session.lease_token = 42;
  session.durable_sequence = 8;
  const v1::OpenIngest open = OpeningOf(session);
  EXPECT_EQ(open.robot(), "missions/house/robots/scout");
  EXPECT_EQ(open.lease_token(), 42);
  EXPECT_EQ(open.durable_sequence(), 8);
}

}  // namespace ingest_messages_test
}  // namespace plumescout::client
