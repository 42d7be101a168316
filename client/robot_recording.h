// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "client/join.h"
#include "client/robot_view.h"
#include "formats/recording_file.h"

namespace plumescout::client {

struct RobotRecordingOptions {
  std::string folder = {};
  RecordingFileOptions file = {};
  // Tells people of files that are begun, and why one could not be written. May be empty.
  std::function<void(const std::string&)> say = nullptr;
};

// A robot's run as MCAP files (client/robot_view.h) while it goes on:
// FOLDER/MISSION/ROBOT.TIME.mcap, of the time in UTC at which this machine began the file. What
// comes between a file that could not be written and the next is missing. Single-threaded; blocks
// as the disk does.
class RobotRecording {
 public:
  // `time_ns`: of the robot's clock, now.
  RobotRecording(const RobotRecordingOptions& options, const Participation& participation,
                 std::int64_t time_ns);

  // So much before it was dropped.
  void Add(const RobotNews& news, std::int64_t missing, RecordingFile::Time now);
  void EndChunkIfDue(RecordingFile::Time now);
  // Nothing follows but what was dropped.
  void Finish(std::int64_t missing, RecordingFile::Time now);

 private:
  absl::Status Begin();
  absl::Status Show(const RobotNews& news);
  absl::Status NoteMissing();
  absl::Status Write() { return file_.Append(view_->Take()); }
  void Fail(const absl::Status& why, RecordingFile::Time now);
  void Leave();
  void Say(const std::string& text) const {
    if (options_.say) options_.say(text);
  }

  const RobotRecordingOptions options_;
  const Participation participation_;
  std::int64_t time_ns_;  // at which a file would begin
  RecordingFile file_;
  std::optional<RobotView> view_;  // none: there is no file now
  std::int64_t missing_ = 0;       // that no file tells of yet
};

}  // namespace plumescout::client
