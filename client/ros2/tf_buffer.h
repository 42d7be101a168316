// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/ros2/transform.h"

namespace plumescout::client {

// The tree of frames that a robot publishes, over the last seconds. Frames are those of /tf and
// /tf_static, without a leading slash. Pure: what time it is comes with the transforms.
class TfBuffer {
 public:
  // Where `child` lies in its parent. kInvalidArgument if it is no transform; a frame that changes
  // its parent, or whose time is set back, is begun anew.
  absl::Status Add(const ros::TransformStamped& transform, bool is_static);

  // Of this frame the newest transform counts at any time: those that SLAM corrects are published
  // late or ahead of time.
  void HoldNewest(const std::string& child) { held_ = child; }

  // Where `source` lies in `target` at a time, between what was published before and after.
  //   kNotFound: a transform that nobody has published yet, or two trees: it will take more news
  //   kUnavailable: the time is after the newest transform: it may come
  //   kOutOfRange: the time is before the oldest one that is kept
  //   kFailedPrecondition: the frames form a loop
  absl::StatusOr<Transform> Lookup(const std::string& target, const std::string& source,
                                   std::int64_t time_ns) const;

  bool Has(const std::string& child) const { return frames_.count(child) > 0; }
  // The last time at which Lookup may answer; nothing if it cannot at any.
  std::optional<std::int64_t> NewestTime_ns(const std::string& target,
                                            const std::string& source) const;
  // The newest transform of the frame, at whatever time; nullptr if there is none.
  const Transform* Newest(const std::string& child) const;
  std::int64_t clocks_set_back() const { return clocks_set_back_; }

 private:
  struct Stamped {
    std::int64_t time_ns = 0;
    Transform transform;
  };
  struct Frame {
    std::string parent;
    bool is_static = false;
    std::deque<Stamped> history;  // by time
  };
  // From a frame up to the root of its tree.
  absl::StatusOr<std::vector<std::string>> WayUp(const std::string& frame) const;
  // In words, of two ways that do not meet.
  std::string DeadEnds(const std::vector<std::string>& from_up,
                       const std::vector<std::string>& to_up) const;
  absl::StatusOr<Transform> InParent(const std::string& child, std::int64_t time_ns) const;
  absl::StatusOr<Transform> InAncestor(const std::vector<std::string>& way, std::size_t steps,
                                       std::int64_t time_ns) const;

  std::map<std::string, Frame> frames_;  // by child
  std::string held_;
  std::int64_t clocks_set_back_ = 0;
};

}  // namespace plumescout::client
