// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "core/belief/belief.h"
#include "formats/journal/event_codec.h"
#include "formats/view/mission_view.h"
#include "server/base/clock.h"
#include "server/observe/mission_metrics.h"

namespace plumescout::server {

// Appends to a file: all of a piece or none of it.
using AppendBytes = std::function<absl::Status(absl::string_view)>;
// Makes a file and the folders above it; kAlreadyExists if it is there.
using OpenRecording = std::function<absl::StatusOr<AppendBytes>(const std::string& path)>;

absl::StatusOr<AppendBytes> OpenRecordingFile(const std::string& path);

struct RecordingOptions {
  std::string folder = {};
  double map_period_s = 10.0;  // of the mission's time
  // What came so long ago can be read whatever becomes of the server.
  absl::Duration chunk_period = absl::Seconds(10);
  std::int64_t max_file_bytes = std::int64_t{1} << 30;
  absl::Duration retry_after = absl::Seconds(30);  // a file that could not be written
  OpenRecording open = OpenRecordingFile;
};

// One mission as MCAP files (formats/view/mission_view.h) while it runs: FOLDER/KEY.N.mcap, which
// begins with event N. There is another one once a file is long enough, or could not be written;
// what comes until then is missing. Single-threaded; blocks as the disk does.
class MissionRecording {
 public:
  // `metrics` is not owned and outlives this.
  MissionRecording(const JournalStart& start, std::string key, RecordingOptions options,
                   MissionMetrics* metrics);

  // `missing` events before it were dropped.
  void Add(MissionMoment moment, std::int64_t missing, SteadyTime now);
  void EndChunkIfDue(SteadyTime now);
  // The mission ends, or leaves the server, with this belief; null: it is not known.
  void Finish(const std::shared_ptr<const Belief>& belief, SteadyTime now);

 private:
  absl::Status Begin(std::int64_t event);
  absl::Status Show(MissionMoment moment);
  absl::Status Write();
  void Fail(const absl::Status& why, SteadyTime now);

  const JournalStart start_;
  const std::string key_;
  const RecordingOptions options_;
  MissionMetrics& metrics_;

  std::string path_;
  AppendBytes append_;
  std::optional<MissionView> view_;  // none: there is no file now
  std::int64_t file_bytes_ = 0;
  std::int64_t missing_events_ = 0;  // that no file tells of yet
  SteadyTime chunk_end_ = SteadyTime::max();
  SteadyTime retry_at_ = SteadyTime::min();
};

}  // namespace plumescout::server
