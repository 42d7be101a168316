// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "client/ros2/transform.h"
#include "core/types/pose2.h"
#include "formats/ros/messages.h"

namespace plumescout::client {

inline ros::TransformStamped Stamped(const std::string& parent, const std::string& child,
                                     std::int64_t time_ns, const Pose2& pose) {
  return {.header = {.stamp = ros::ToTime(time_ns), .frame_id = parent},
          .child_frame_id = child,
          .transform = FromPlanar(pose)};
}

}  // namespace plumescout::client
