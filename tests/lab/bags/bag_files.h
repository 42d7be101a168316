// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "formats/file_io.h"
#include "formats/mcap/mcap_encoder.h"
#include "formats/ros/cdr_writer.h"
#include "formats/ros/messages.h"
#include "lab/bags/bag_reader.h"
#include "tests/client/ros2/stamped.h"
#include "tests/support/box_room.h"

namespace plumescout::lab {

// As rosbag2 writes them; `encodings` of topics that are no CDR.
using Encodings = std::map<std::string, std::string>;

inline void WriteMcapBag(const std::string& path, const std::vector<BagMessage>& messages,
                         const Encodings& encodings = {}) {
  McapEncoder encoder("libmcap", McapCompression::kNone, /*chunk_bytes=*/20'000);
  std::map<std::string, std::uint16_t> channels;
  for (const BagMessage& message : messages) {
    std::uint16_t& channel = channels[message.topic];
    if (channel == 0) {
      const auto other = encodings.find(message.topic);
      channel = encoder.AddChannel(message.topic, other == encodings.end() ? "cdr" : other->second,
                                   encoder.AddSchema(message.type, "ros2msg", "..."));
    }
    const auto time_ns = static_cast<std::uint64_t>(message.log_time_ns);
    ASSERT_TRUE(encoder.Add({channel, 0, time_ns, time_ns, message.cdr}).ok());
  }
  ASSERT_TRUE(encoder.Finish().ok());
  ASSERT_TRUE(WriteFile(path, encoder.Take()).ok());
}

void WriteSqliteBag(const std::string& path, const std::vector<BagMessage>& messages,
                    const Encodings& encodings = {});

template <typename Message>
BagMessage Recorded(const std::string& topic, std::int64_t time_ns, const Message& message) {
  return {topic, Message::kType, time_ns, ros::EncodeCdr(message)};
}

// What a robot publishes that stands in a room of 5 x 4 m for so many tenths of a second.
inline std::vector<BagMessage> RoomBag(int tenths) {
  constexpr std::int64_t kBegin_ns = 1'600'000'000'000'000'000;
  constexpr Pose2 kPose = {1.5, 1.0, 0.5};
  using client::Stamped;
  std::vector<BagMessage> messages = {
      Recorded("/tf_static", kBegin_ns,
               ros::TfMessage{{Stamped("base_link", "laser", 0, {0.1, 0.0, 0.0})}})};
  for (int i = 0; i < tenths; ++i) {
    const std::int64_t time_ns = kBegin_ns + i * std::int64_t{100'000'000};
    messages.push_back(
        Recorded("/tf", time_ns,
                 ros::TfMessage{{Stamped("map", "odom", time_ns, {1.0, 0.0, 0.0}),
                                 Stamped("odom", "base_link", time_ns, {0.5, 1.0, 0.5})}}));
    const Scan seen = support::ScanInBox(Compose(kPose, {0.1, 0.0, 0.0}), 5.0, 4.0);
    ros::LaserScan scan;
    scan.header = {ros::ToTime(time_ns), "laser"};
    scan.angle_min = static_cast<float>(seen.start_angle_rad);
    scan.angle_increment = static_cast<float>(seen.angle_step_rad);
    scan.range_max = static_cast<float>(seen.max_range_m);
    scan.ranges = seen.ranges_m;
    messages.push_back(Recorded("/scan", time_ns, scan));
    ros::GasSensor gas;
    gas.header = {ros::ToTime(time_ns), "base_link"};
    gas.raw = 7.0;
    gas.raw_units = ros::GasSensor::kPpm;
    messages.push_back(Recorded("/PID/Sensor_reading", time_ns, gas));
  }
  return messages;
}

// All that comes, and how it ends.
struct BagReading {
  std::vector<BagMessage> messages;
  absl::Status end;
  std::string torn_end;
};
inline BagReading ReadAll(BagReader& bag) {
  BagReading reading;
  while (true) {
    auto message = bag.Next();
    reading.end = message.status();
    if (!message.ok() || !*message) break;
    reading.messages.push_back(**std::move(message));
  }
  reading.torn_end = bag.torn_end();
  return reading;
}

// The first so many bytes of a file, as another; whole pages of `page_bytes`.
inline void CutFile(const std::string& path, double share, const std::string& cut,
                    std::size_t page_bytes = 1) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 26;
  const auto bytes = ReadFile(path, kMost);
  ASSERT_TRUE(bytes.ok()) << bytes.status();
  const auto kept = static_cast<std::size_t>(static_cast<double>(bytes->size()) * share);
  ASSERT_TRUE(WriteFile(cut, bytes->substr(0, kept - kept % page_bytes)).ok());
}

}  // namespace plumescout::lab
