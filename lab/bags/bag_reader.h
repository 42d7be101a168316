// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "absl/status/statusor.h"

namespace plumescout::lab {

// A message that rosbag2 has recorded.
struct BagMessage {
  std::string topic = {};
  std::string type = {};         // sensor_msgs/msg/LaserScan
  std::int64_t log_time_ns = 0;  // when the recorder heard it
  std::string cdr = {};

  friend bool operator==(const BagMessage&, const BagMessage&) = default;
};

// Reads a recording of rosbag2 from its beginning to its end, one message at a time.
class BagReader {
 public:
  virtual ~BagReader() = default;

  // The next message of the topics that are wanted; nothing once the bag ends. One that was cut off
  // is an end too, after its last whole message: see torn_end(). kDataLoss, naming the file, for
  // other damage.
  virtual absl::StatusOr<std::optional<BagMessage>> Next() = 0;

  // Why there may have been more, as a sentence without a full stop; empty: it is whole so far.
  virtual const std::string& torn_end() const = 0;
  virtual double share_read() const = 0;  // [0, 1]

  // Messages of wanted topics that were passed over since they are no CDR, by their encoding.
  const std::map<std::string, std::int64_t>& unknown_encodings() const {
    return unknown_encodings_;
  }
  // All topics that came up, with their types.
  const std::map<std::string, std::string>& topics() const { return topics_; }

 protected:
  std::map<std::string, std::int64_t> unknown_encodings_;
  std::map<std::string, std::string> topics_;
};

// Opens an MCAP file or a file of SQLite. Errors, naming the file: kNotFound; kInvalidArgument for
// what is neither.
absl::StatusOr<std::unique_ptr<BagReader>> OpenBag(const std::string& path,
                                                   const std::set<std::string>& wanted_topics);

}  // namespace plumescout::lab
