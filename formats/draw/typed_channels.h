// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "absl/status/status.h"
#include "formats/mcap/mcap_encoder.h"

namespace google::protobuf {
class Descriptor;
class Message;
}  // namespace google::protobuf

namespace plumescout {

// When a message was made, by its own time, and when the mission came to know it, which never goes
// back from one message to the next. Nanoseconds since the Unix epoch.
struct McapTimes {
  std::int64_t log_ns = 0;
  std::int64_t publish_ns = 0;
};

// The channels of an MCAP file whose messages are of protobuf. A channel begins with its first
// message, and so does the schema, which holds the message's .proto file and those that it imports,
// with what the message is made of alone.
class TypedChannels {
 public:
  // Not owned; outlives this.
  explicit TypedChannels(McapEncoder* encoder) : encoder_(*encoder) {}

  // Errors as of McapEncoder::Add. REQUIRES: all messages of a topic are of one type.
  absl::Status Add(const std::string& topic, const google::protobuf::Message& message,
                   McapTimes times);

 private:
  struct Channel {
    std::uint16_t id = 0;
    std::uint32_t messages = 0;
  };
  std::uint16_t SchemaOf(const google::protobuf::Descriptor& type);

  McapEncoder& encoder_;
  std::map<std::string, std::uint16_t> schemas_;
  std::map<std::string, Channel> channels_;
};

}  // namespace plumescout
