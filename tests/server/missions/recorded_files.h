// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/mission/mission.h"
#include "formats/file_io.h"
#include "formats/mcap/mcap_encoder.h"
#include "formats/mcap/mcap_journal.h"
#include "foxglove/schemas.pb.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {

// What an MCAP file of a mission says.
struct RecordedFile {
  std::vector<std::int64_t> events;  // their numbers
  std::vector<EventBody> bodies;
  std::vector<std::string> log;
  std::map<std::string, std::vector<McapMessage>> by_topic;
  std::string torn_end;
};

inline RecordedFile ReadRecording(const std::string& path) {
  RecordedFile file;
  auto reader = McapReader::Open(path);
  EXPECT_TRUE(reader.ok()) << reader.status();
  if (!reader.ok()) return file;
  auto message = reader->Next();
  for (; message.ok() && *message; message = reader->Next()) {
    const std::string topic = reader->channels().at((*message)->channel).topic;
    if (topic == kMcapJournalTopic && (*message)->sequence > 0) {
      const auto event = DecodeEvent((*message)->data);
      EXPECT_TRUE(event.ok()) << event.status();
      file.events.push_back(event->number);
      file.bodies.push_back(event->body);
    }
    if (topic == "/log") {
      foxglove::Log log;
      EXPECT_TRUE(log.ParseFromString((*message)->data));
      file.log.push_back(log.message());
    }
    (*message)->channel = 0;  // their numbers may differ
    file.by_topic[topic].push_back(**message);
  }
  EXPECT_TRUE(message.ok()) << message.status();
  file.torn_end = reader->torn_end();
  return file;
}

// Of the mission of default options that its events make.
inline std::uint64_t DigestOf(const RecordedFile& file) {
  Mission mission{MissionOptions()};
  for (const EventBody& body : file.bodies) EXPECT_TRUE(mission.Apply(body).ok());
  return mission.Digest();
}

inline std::string TextOf(const prometheus::Registry& registry) {
  return prometheus::TextSerializer().Serialize(registry.Collect());
}

}  // namespace plumescout::server
