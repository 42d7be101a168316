// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "formats/mcap/mcap_reader.h"
#include "foxglove/schemas.pb.h"

namespace plumescout::client {

// What an MCAP file of a robot's run says.
struct RecordedRun {
  std::map<std::string, std::vector<McapMessage>> by_topic;
  std::vector<std::string> log;
  std::string torn_end;

  std::size_t Count(const std::string& topic) const {
    const auto messages = by_topic.find(topic);
    return messages == by_topic.end() ? 0 : messages->second.size();
  }
};

inline RecordedRun ReadRun(const std::string& path) {
  RecordedRun run;
  auto reader = McapReader::Open(path);
  EXPECT_TRUE(reader.ok()) << reader.status();
  if (!reader.ok()) return run;
  std::uint64_t last_ns = 0;
  auto message = reader->Next();
  for (; message.ok() && *message; message = reader->Next()) {
    EXPECT_GE((*message)->log_time_ns, last_ns);
    last_ns = (*message)->log_time_ns;
    const std::string topic = reader->channels().at((*message)->channel).topic;
    if (topic == "/log") {
      foxglove::Log log;
      EXPECT_TRUE(log.ParseFromString((*message)->data));
      run.log.push_back(log.message());
    }
    run.by_topic[topic].push_back(**message);
  }
  EXPECT_TRUE(message.ok()) << message.status();
  run.torn_end = reader->torn_end();
  return run;
}

// The files that were recorded below the folder, by their names.
inline std::vector<std::string> RecordingsIn(const std::string& folder) {
  std::vector<std::string> paths;
  if (!std::filesystem::exists(folder)) return paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".mcap") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace plumescout::client
