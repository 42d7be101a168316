// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "core/belief/belief.h"
#include "formats/journal/event_codec.h"
#include "formats/recording_file.h"
#include "formats/view/mission_view.h"
#include "server/base/clock.h"
#include "server/observe/mission_metrics.h"

namespace plumescout::server {

struct RecordingOptions {
  std::string folder = {};
  double map_period_s = 10.0;  // of the mission's time
  double map_share = MissionView::kMapShare;
  RecordingFileOptions file = {};
};

// One mission as MCAP files (formats/view/mission_view.h) while it runs: FOLDER/KEY.N.mcap, which
// begins with event N. What comes between a file that could not be written and the next is missing.
// Single-threaded; blocks as the disk does.
class MissionRecording {
 public:
  // `metrics` is not owned and outlives this.
  MissionRecording(const JournalStart& start, std::string key, const RecordingOptions& options,
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
  const std::string folder_;
  const double map_share_;
  MissionMetrics& metrics_;

  RecordingFile file_;
  std::optional<MissionView> view_;  // none: there is no file now
  std::int64_t missing_events_ = 0;  // that no file tells of yet
};

}  // namespace plumescout::server
