// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>

#include "absl/strings/str_cat.h"
#include "google/protobuf/descriptor.h"
#include "server/config/config_convert.h"

namespace plumescout::server {
namespace config_test {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string RefusalOf(const ServerConfig& config) {
  EXPECT_TRUE(absl::IsInvalidArgument(Validate(config)));
  return std::string(Validate(config).message());
}

TEST(ConfigTest, DefaultsAreValid) { EXPECT_EQ(Validate(ServerConfig()), absl::OkStatus()); }

TEST(ConfigTest, RefusalsNameOptionValueAndRange) {
  ServerConfig config;
  config.planning.threads = 0;
  EXPECT_EQ(RefusalOf(config), "planning.threads = 0 must be in [1, 256]");
  config = {};
  config.limits.memory_budget_bytes = 1000;
  EXPECT_EQ(RefusalOf(config),
            "limits.memory_budget_bytes = 1000 must be in [33554432, 1000000000000]");
}

TEST(ConfigTest, AMissionByDefaultIsOneThatTheServerTakes) {
  ServerConfig config;
  config.limits.max_beam_count = config.mission.max_beam_count - 1;
  EXPECT_THAT(RefusalOf(config), StartsWith("mission.max_beam_count = 4096"));
  config = {};
  config.limits.mission_memory_budget_bytes = config.mission.memory_budget_bytes - 1;
  EXPECT_THAT(RefusalOf(config), StartsWith("mission.memory_budget_bytes"));
  config = {};
  config.limits.memory_budget_bytes = config.mission.memory_budget_bytes - 1;
  EXPECT_THAT(RefusalOf(config), StartsWith("mission.memory_budget_bytes"));
  config = {};
  config.limits.max_range_m = config.mission.max_range_m / 2.0;
  EXPECT_THAT(RefusalOf(config), StartsWith("mission.max_range_m"));
  config = {};
  config.limits.max_map_cell_count = config.mission.occupancy.max_cell_count - 1;
  EXPECT_THAT(RefusalOf(config), StartsWith("mission.occupancy.max_cell_count"));
}

TEST(ConfigTest, AsManyMissionsAsAreAllowedFitTheBudget) {
  const ServerConfig config;
  EXPECT_LE(config.limits.max_missions * config.mission.memory_budget_bytes,
            config.limits.memory_budget_bytes);
}

void Set(const FieldDescriptor& field, double value, Message& message) {
  const auto& reflection = *message.GetReflection();
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
    reflection.SetDouble(&message, &field, value);
  } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_INT64) {
    reflection.SetInt64(&message, &field, static_cast<std::int64_t>(value));
  } else {
    const double most = std::numeric_limits<std::int32_t>::max();
    reflection.SetInt32(&message, &field, static_cast<std::int32_t>(std::min(value, most)));
  }
}

TEST(ConfigTest, EveryNumberHasARange) {
  const Message& defaults = config::v1::ServerConfig::default_instance();
  int checked = 0;
  for (int i = 0; i < defaults.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& part = *defaults.GetDescriptor()->field(i);
    if (part.message_type() == nullptr || part.name() == "mission") continue;
    for (int k = 0; k < part.message_type()->field_count(); ++k) {
      const FieldDescriptor& field = *part.message_type()->field(k);
      if (field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) continue;
      if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) continue;
      for (const double value : {-1.0, 2e12}) {
        config::v1::ServerConfig proto;
        Set(field, value, *proto.GetReflection()->MutableMessage(&proto, &part));
        const auto config = ServerConfigFromProto(proto);
        EXPECT_THAT(std::string(config.status().message()),
                    StartsWith(absl::StrCat(part.name(), ".", field.name(), " = ")));
        ++checked;
      }
    }
  }
  EXPECT_GE(checked, 2 * 25);
}

TEST(ConfigTest, NanIsRefused) {
  ServerConfig config;
  config.connection.drain_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(RefusalOf(config), StartsWith("connection.drain_s = "));
}

TEST(ConfigTest, QueueMustHoldAWindowAndABatch) {
  ServerConfig config;
  config.limits.max_queued_observations = config.limits.max_batch_observations - 1;
  EXPECT_THAT(RefusalOf(config), HasSubstr("limits.max_queued_observations = 1023 must hold"));
  config = {};
  config.limits.stream_window_observations = config.limits.max_queued_observations + 1;
  EXPECT_THAT(RefusalOf(config), HasSubstr("limits.max_queued_observations = 4096 must hold"));
}

TEST(ConfigTest, RoomOfAMissionMustHoldARequest) {
  ServerConfig config;
  config.limits.max_queued_bytes = config.limits.max_receive_bytes;
  EXPECT_THAT(RefusalOf(config), HasSubstr("limits.max_queued_bytes = 262144 must hold"));
}

TEST(ConfigTest, RoomOfAllMissionsMustFitIntoTheBudget) {
  ServerConfig config;
  config.limits.max_queued_bytes = config.limits.memory_budget_bytes / config.limits.max_missions;
  EXPECT_TRUE(Validate(config).ok());
  ++config.limits.max_queued_bytes;
  EXPECT_THAT(RefusalOf(config), HasSubstr("must fit into limits.memory_budget_bytes"));
}

TEST(ConfigTest, FilesOfTlsGoTogether) {
  ServerConfig config;
  config.access.tls_certificate_file = "crt";
  EXPECT_THAT(RefusalOf(config), StartsWith("access.tls_key_file = "));
  config = {};
  config.access.client_ca_file = "ca";
  EXPECT_THAT(RefusalOf(config), StartsWith("access.client_ca_file = ca needs"));
  config = {};
  config.access.require_client_certificate = true;
  EXPECT_THAT(RefusalOf(config), StartsWith("access.require_client_certificate = true needs"));
  config = {};
  config.access.trusted_front = "front.example.org";
  EXPECT_THAT(RefusalOf(config), StartsWith("access.trusted_front = front.example.org must"));
  for (const char* front : {kLocalFront, kUnixFront}) {
    config.access.trusted_front = front;
    EXPECT_EQ(Validate(config), absl::OkStatus());
  }
  config.access.allow_anonymous = true;
  EXPECT_THAT(RefusalOf(config), StartsWith("access.allow_anonymous = true would"));
}

TEST(ConfigTest, WhatOtherMachinesReachIsEncryptedAndGuardedUnlessAskedFor) {
  ServerConfig config;
  config.listen = "0.0.0.0:50551";
  EXPECT_THAT(RefusalOf(config), HasSubstr("access.allow_plaintext = true"));
  config.access.allow_plaintext = true;
  EXPECT_THAT(RefusalOf(config), HasSubstr("access.allow_anonymous = true"));
  config.access.allow_anonymous = true;
  EXPECT_EQ(Validate(config), absl::OkStatus());
  config.access = {};
  config.access.tls_certificate_file = "crt";
  config.access.tls_key_file = "key";
  EXPECT_THAT(RefusalOf(config), StartsWith("listen = 0.0.0.0:50551 "));
  config.access.tokens_file = "tokens";
  EXPECT_EQ(Validate(config), absl::OkStatus());
}

TEST(ConfigTest, ConsoleThatOtherMachinesReachIsGuardedUnlessAskedFor) {
  ServerConfig config;
  config.console.listen = "127.0.0.1:8080";
  EXPECT_EQ(Validate(config), absl::OkStatus());
  config.console.listen = "0.0.0.0:8080";
  EXPECT_THAT(RefusalOf(config), StartsWith("console.listen = 0.0.0.0:8080 "));
  EXPECT_THAT(RefusalOf(config), HasSubstr("access.allow_plaintext = true"));
  config.access.allow_plaintext = true;
  EXPECT_THAT(RefusalOf(config), HasSubstr("access.tokens_file"));
  config.access.tokens_file = "tokens";
  EXPECT_EQ(Validate(config), absl::OkStatus());
  EXPECT_FALSE(IsServedLocally(config));
  EXPECT_TRUE(IsServedLocally(ServerConfig()));
}

TEST(ConfigTest, ConsoleHasAnAddressAndRoomForStreams) {
  for (const char* address : {"localhost", "127.0.0.1:", "unix:/run/console"}) {
    ServerConfig config;
    config.console.listen = address;
    EXPECT_EQ(RefusalOf(config),
              absl::StrCat("console.listen = ", address, " must be HOST:PORT or empty"));
  }
  ServerConfig config;
  config.console.max_stream_count = 0;
  EXPECT_THAT(RefusalOf(config), StartsWith("console.max_stream_count = 0 "));
  config = {};
  config.console.hosts = "console.example,[::1]:8080";
  EXPECT_EQ(Validate(config), absl::OkStatus());
  config.console.hosts = "https://console.example";
  EXPECT_THAT(RefusalOf(config), StartsWith("console.hosts = https://console.example must be "));
}

TEST(ConfigTest, WordsAreChecked) {
  ServerConfig config;
  config.observe.log_level = "loud";
  EXPECT_EQ(RefusalOf(config),
            "observe.log_level = loud must be one of debug, info, warning, error");
  config = {};
  config.observe.log_format = "xml";
  EXPECT_EQ(RefusalOf(config), "observe.log_format = xml must be one of text, json");
  for (const char* address : {"localhost", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:-1"}) {
    config = {};
    config.observe.http_listen = address;
    EXPECT_EQ(RefusalOf(config),
              absl::StrCat("observe.http_listen = ", address, " must be HOST:PORT, auto or empty"));
  }
}

std::string HttpBeside(const std::string& listen, const std::string& http_listen = "auto") {
  ServerConfig config;
  config.listen = listen;
  config.observe.http_listen = http_listen;
  return HttpListen(config);
}

TEST(ConfigTest, HttpStandsBesideTheServiceUnlessToldOtherwise) {
  EXPECT_EQ(HttpListen(ServerConfig()), "127.0.0.1:50552");
  EXPECT_EQ(HttpBeside("[::]:7000"), "127.0.0.1:7001");
  EXPECT_EQ(HttpBeside("0.0.0.0:0"), "127.0.0.1:0");
  EXPECT_EQ(HttpBeside("0.0.0.0:65535"), "127.0.0.1:0");
  EXPECT_EQ(HttpBeside("unix:/run/plumescout"), "");
  EXPECT_EQ(HttpBeside(""), "");
  EXPECT_EQ(HttpBeside("0.0.0.0:1", "0.0.0.0:9"), "0.0.0.0:9");
  EXPECT_EQ(HttpBeside("0.0.0.0:1", ""), "");
}

TEST(ConfigTest, WhereMissionsAreKeptIsChecked) {
  ServerConfig config;
  EXPECT_EQ(config.store.engine, kNoStore) << "whoever makes a server says where it may write";
  EXPECT_EQ(ProgramDefaults().store.engine, kSqliteStore);
  config.store.engine = "floppy";
  EXPECT_EQ(RefusalOf(config), "store.engine = floppy must be one of none, sqlite, postgresql");
  config.store = StoreConfig();
  config.store.recovery_threads = 0;
  EXPECT_THAT(RefusalOf(config), StartsWith("store.recovery_threads = 0 "));
  config.store = StoreConfig();
  config.store.sleep_after_s = -1.0;
  EXPECT_THAT(RefusalOf(config), StartsWith("store.sleep_after_s = -1 "));
}

TEST(ConfigTest, ASharedStoreNeedsAUrlAndAWordForTheNode) {
  ServerConfig config;
  config.store.engine = kPostgresqlStore;
  config.store.url = "scout:secret@db";
  config.store.node = "n1";
  EXPECT_EQ(RefusalOf(config),
            "store.url must be postgresql://user@host:port/database for store.engine = postgresql");
  config.store.url = "postgres://db/plumes";
  EXPECT_TRUE(Validate(config).ok()) << Validate(config);
  for (const std::string& node : {std::string(), std::string("n 1"), std::string(64, 'n')}) {
    config.store.node = node;
    EXPECT_THAT(RefusalOf(config), StartsWith("store.node = " + node + " must be a word of 1 to"));
  }
  config.store.node = "n1";
  config.store.cluster = "two words";
  EXPECT_THAT(RefusalOf(config), StartsWith("store.cluster = two words must be a word of 1 to"));
  config.store.cluster = "harbour";
  config.store.lease_s = 0.1;
  EXPECT_THAT(RefusalOf(config), StartsWith("store.lease_s = 0.1 "));
}

// The variables are the user's; a test that sets them must be alone in its process.
TEST(ConfigTest, MissionsAreKeptInTheUsersFolderOfState) {
  StoreConfig store;
  store.folder = "here";
  EXPECT_EQ(StoreFolder(store).value(), "here");
  store.folder = "";
  setenv("HOME", "/home/ann", 1);
  setenv("XDG_STATE_HOME", "/state", 1);
  EXPECT_EQ(StoreFolder(store).value(), "/state/plumescout");
  setenv("XDG_STATE_HOME", "not/absolute", 1);
  EXPECT_EQ(StoreFolder(store).value(), "/home/ann/.local/state/plumescout");
  unsetenv("XDG_STATE_HOME");
  unsetenv("HOME");
  EXPECT_TRUE(absl::IsInvalidArgument(StoreFolder(store).status()));
}

TEST(ConfigTest, OptionsOfMissionsAreChecked) {
  ServerConfig config;
  config.mission.planning.beta = -1.0;
  EXPECT_THAT(RefusalOf(config), StartsWith("mission.planning.beta = -1 "));
}

}  // namespace config_test
}  // namespace plumescout::server
