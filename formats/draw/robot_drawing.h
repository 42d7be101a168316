// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "core/types/ids.h"
#include "core/types/observation.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/robot_frame.h"
#include "formats/draw/typed_channels.h"

namespace plumescout {

// Whether it is time to show something again; notes that it is shown. Of robots that send what they
// kept, times go back.
bool IsDue(std::int64_t time_ns, std::int64_t period_ns, std::optional<std::int64_t>& shown_ns);

// What viewers draw of robots, in frame `map`:
//
//   topic                 schema                    when
//   /robots/NAME/pose     foxglove.PoseInFrame      every 0.2 s
//   /robots/NAME/scan     foxglove.LaserScan        every second
//   /robots/NAME/gas      plumescout.v1.Observation  each reading
//   /plans                plumescout.v1.Plan        each plan
//   /scene/plans          foxglove.SceneUpdate      the ways of live plans
//   /log                  foxglove.Log              what happens, in words
//
// Errors are those of McapEncoder::Add. Single-threaded.
class RobotDrawing {
 public:
  // Not owned; outlives this.
  explicit RobotDrawing(TypedChannels* channels) : channels_(*channels) {}

  // If it is time.
  absl::Status DrawPose(const RobotId& robot, const Pose2& pose, McapTimes times);
  // Where it was, and what it saw there. `frame`: of its poses.
  absl::Status DrawObservation(const RobotId& robot, const RobotFrame& frame,
                               const Observation& observation, McapTimes times);
  absl::Status DrawPlan(const MissionId& mission, const Plan& plan, McapTimes times);
  // The robot does not follow its plan any more.
  absl::Status DrawEndOfPlan(const RobotId& robot, McapTimes times);
  // `name`: who it is about.
  absl::Status DrawLine(bool is_warning, absl::string_view name, absl::string_view line,
                        McapTimes times);

 private:
  // What of a robot was shown last, by the message's own time.
  struct Shown {
    std::optional<std::int64_t> pose_ns;
    std::optional<std::int64_t> scan_ns;
  };

  TypedChannels& channels_;
  std::map<RobotId, Shown> shown_;
};

}  // namespace plumescout
