// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config_convert.h"

#include <gtest/gtest.h>

#include <string>

#include "google/protobuf/descriptor.h"
#include "google/protobuf/util/message_differencer.h"

namespace plumescout::server {
namespace config_convert_test {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::util::MessageDifferencer;

ServerConfig Unlike() {
  ServerConfig config;
  config.listen = "[::]:1";
  config.limits = {2,    3'000'000'000, 5000,       4,    5,     6,    7,      8,         10'001,
                   8.5,  2'000'000'000, 5'000'000,  9000, 250.0, 51.0, 1001.0, 5e6,       21.0,
                   61.0, 6.0,           70'000'000, 65,   66.0,  67.0, 1,      80'000'000};
  config.planning = {9, 10, 0.5, 11.0, 0.25, true, 1, 2, 3};
  config.maps = {12, 13, 0.75, 0.125, 14, 15, 1'000'000};
  config.epochs = {14, 15};
  config.connection = {16.0, 17.0, 18.0, 19.0, 20.0, 20.5};
  config.access = {"a", "b", "c", true, "d", true, true, "e"};
  config.mission.seed = 21;
  config.observe = {"127.0.0.1:1", "debug", "json", 0.5, false, true};
  config.store = {kSqliteStore,       "f",  1'000'000, 3,   0.5, 30.0,
                  "postgresql://h/d", "n1", 2.0,       "i", "j"};
  config.console = {"127.0.0.1:2", "g", 5, "h"};
  config.record = {"i", 2.0, 0.5, 3.0, 2'000'000};
  return config;
}

TEST(ConfigConvertTest, EveryOptionSurvivesTheRoundTrip) {
  const config::v1::ServerConfig proto = ServerConfigToProto(Unlike());
  const auto back = ServerConfigFromProto(proto);
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_TRUE(MessageDifferencer::Equals(ServerConfigToProto(*back), proto));
  EXPECT_EQ(back->listen, "[::]:1");
  EXPECT_EQ(back->limits.memory_budget_bytes, 3'000'000'000);
  EXPECT_EQ(back->limits.max_streams_per_connection, 8);
  EXPECT_EQ(back->limits.max_connection_bytes, 80'000'000);
  EXPECT_EQ(back->planning.deadline_margin_s, 0.25);
  EXPECT_TRUE(back->planning.rivals);
  EXPECT_EQ(back->maps.gas_wait_s, 0.125);
  EXPECT_EQ(back->epochs.max_queued, 15);
  EXPECT_EQ(back->connection.drain_s, 20.0);
  EXPECT_EQ(back->connection.self_probe_period_s, 20.5);
  EXPECT_EQ(back->access.tls_certificate_file, "a");
  EXPECT_EQ(back->access.tokens_file, "d");
  EXPECT_TRUE(back->access.allow_plaintext);
  EXPECT_EQ(back->mission.seed, 21u);
  EXPECT_EQ(back->observe.log_format, "json");
  EXPECT_TRUE(back->observe.channelz);
  EXPECT_EQ(back->store.engine, kSqliteStore);
  EXPECT_EQ(back->store.recovery_threads, 3);
  EXPECT_EQ(back->console.folder, "g");
  EXPECT_EQ(back->record.max_file_bytes, 2'000'000);
}

// A field that conversion forgot is unset, or keeps its default.
void ExpectEveryFieldUnlike(const Message& defaults, const Message& message) {
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor* field = message.GetDescriptor()->field(i);
    if (field->name() == "mission") continue;  // see tests/proto/convert/options_test.cc
    ASSERT_TRUE(message.GetReflection()->HasField(message, field)) << field->full_name();
    if (field->message_type() != nullptr) {
      ExpectEveryFieldUnlike(defaults.GetReflection()->GetMessage(defaults, field),
                             message.GetReflection()->GetMessage(message, field));
    } else {
      MessageDifferencer differencer;
      EXPECT_FALSE(differencer.CompareWithFields(defaults, message, {field}, {field}))
          << field->full_name();
    }
  }
}

TEST(ConfigConvertTest, EveryFieldIsConverted) {
  ExpectEveryFieldUnlike(
      ServerConfigToProto(ServerConfig()),
      ServerConfigToProto(*ServerConfigFromProto(ServerConfigToProto(Unlike()))));
}

TEST(ConfigConvertTest, FieldsThatAreUnsetKeepTheirDefaults) {
  EXPECT_TRUE(MessageDifferencer::Equals(ServerConfigToProto(*ServerConfigFromProto({})),
                                         ServerConfigToProto(ServerConfig())));
}

TEST(ConfigConvertTest, AStrategySetsThePartsOfItsRow) {
  config::v1::ServerConfig proto;
  proto.mutable_mission()->mutable_planning()->set_strategy("xit_f");
  EXPECT_EQ(ServerConfigFromProto(proto)->mission.planning.goal_policy, GoalPolicy::kOccupancyOnly);
}

TEST(ConfigConvertTest, RefusalsBeginWithTheOption) {
  config::v1::ServerConfig proto;
  proto.mutable_mission()->mutable_gas()->set_lattice_factor(17);
  EXPECT_EQ(ServerConfigFromProto(proto).status().message(),
            "mission.gas.lattice_factor = 17 must be in [1, 16]");
  proto.clear_mission();
  proto.mutable_epochs()->set_threads(0);
  EXPECT_EQ(ServerConfigFromProto(proto).status().message(),
            "epochs.threads = 0 must be in [1, 256]");
}

}  // namespace config_convert_test
}  // namespace plumescout::server
