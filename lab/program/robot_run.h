// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "client/planner_client.h"
#include "core/types/ids.h"
#include "core/types/observation.h"
#include "formats/mcap/mcap_reader.h"

namespace plumescout::lab {

// Reads what a robot's own program has recorded of its run (client/robot_view.h): who it was, and
// what it told the server. Not thread-safe.
class RobotRun {
 public:
  // None: the file is not of a robot's program. Errors as of McapReader; kDataLoss for a
  // registration that is none.
  static absl::StatusOr<std::optional<RobotRun>> Open(const std::string& path);

  const RobotId& robot() const { return robot_; }
  double radius_m() const { return radius_m_; }
  const client::RobotOutfit& outfit() const { return outfit_; }

  // The next observation; nothing once the file ends. Those that make no sense are counted and
  // passed over. Errors as of McapReader.
  absl::StatusOr<std::optional<Observation>> Next();
  std::int64_t senseless() const { return senseless_; }
  const absl::Status& first_senseless() const { return first_senseless_; }

  const std::string& torn_end() const { return reader_.torn_end(); }
  double share_read() const { return reader_.share_read(); }

 private:
  explicit RobotRun(McapReader reader) : reader_(std::move(reader)) {}
  // Whether the message is of that topic and type.
  bool Is(const McapMessage& message, absl::string_view topic, const std::string& type) const;

  McapReader reader_;
  RobotId robot_;
  double radius_m_ = 0.0;
  client::RobotOutfit outfit_;
  std::int64_t senseless_ = 0;
  absl::Status first_senseless_;
};

}  // namespace plumescout::lab
