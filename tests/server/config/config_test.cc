// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
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
  config.limits.max_total_cells = 2'000'000'000'000;
  EXPECT_EQ(RefusalOf(config), "limits.max_total_cells = 2e+12 must be in [1, 1e+12]");
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
      for (const double value : {-1.0, 2e12}) {
        config::v1::ServerConfig proto;
        Set(field, value, *proto.GetReflection()->MutableMessage(&proto, &part));
        const auto config = FromProto(proto);
        EXPECT_THAT(std::string(config.status().message()),
                    StartsWith(absl::StrCat(part.name(), ".", field.name(), " = ")));
        ++checked;
      }
    }
  }
  EXPECT_GE(checked, 2 * 24);
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

TEST(ConfigTest, OptionsOfMissionsAreChecked) {
  ServerConfig config;
  config.mission.planning.beta = -1.0;
  EXPECT_THAT(RefusalOf(config), StartsWith("mission.planning.beta = -1 "));
}

}  // namespace config_test
}  // namespace plumescout::server
