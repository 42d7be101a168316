// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/tf_buffer.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/strip.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr std::int64_t kKept_ns = 10'000'000'000;
constexpr std::size_t kMostKept = 4096;  // of one frame
constexpr std::size_t kMostFrames = 1024;
constexpr double kNanosecondsPerSecond = 1e9;

std::string Seconds(std::int64_t time_ns) {
  return absl::StrCat(static_cast<double>(time_ns) / kNanosecondsPerSecond, " s");
}

std::string NameOf(const std::string& frame) { return std::string(absl::StripPrefix(frame, "/")); }

}  // namespace

absl::Status TfBuffer::Add(const ros::TransformStamped& transform, bool is_static) {
  const std::string child = NameOf(transform.child_frame_id);
  const std::string parent = NameOf(transform.header.frame_id);
  const auto normal = Normalise(transform.transform);
  const std::string name = absl::StrCat("transform ", parent, " → ", child);
  if (child.empty() || parent.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(name, " lacks the name of a frame"));
  }
  if (child == parent) {
    return absl::InvalidArgumentError(absl::StrCat(name, " is a loop"));
  }
  if (!normal) {
    return absl::InvalidArgumentError(absl::StrCat(name, " is not finite or has no rotation"));
  }
  if (!Has(child) && frames_.size() >= kMostFrames) {
    return absl::InvalidArgumentError(absl::StrCat(name, ": more frames than ", kMostFrames));
  }
  Frame& frame = frames_[child];
  const std::int64_t time_ns = ros::ToNanoseconds(transform.header.stamp);
  const bool set_back = !frame.history.empty() && time_ns < frame.history.back().time_ns - kKept_ns;
  if (set_back && !is_static) ++clocks_set_back_;
  if (is_static || frame.is_static || frame.parent != parent || set_back) frame.history.clear();
  frame.parent = parent;
  frame.is_static = is_static;
  const auto after = std::upper_bound(
      frame.history.begin(), frame.history.end(), time_ns,
      [](std::int64_t time, const Stamped& stamped) { return time < stamped.time_ns; });
  frame.history.insert(after, {time_ns, *normal});
  while (frame.history.size() > kMostKept ||
         frame.history.front().time_ns < frame.history.back().time_ns - kKept_ns) {
    frame.history.pop_front();
  }
  return absl::OkStatus();
}

const Transform* TfBuffer::Newest(const std::string& child) const {
  const auto found = frames_.find(child);
  return found == frames_.end() ? nullptr : &found->second.history.back().transform;
}

std::optional<std::int64_t> TfBuffer::NewestTime_ns(const std::string& target,
                                                    const std::string& source) const {
  std::int64_t newest_ns = std::numeric_limits<std::int64_t>::max();
  for (const std::string& end : {NameOf(source), NameOf(target)}) {
    const auto way = WayUp(end);
    if (!way.ok()) return std::nullopt;
    for (const std::string& name : *way) {
      const auto found = frames_.find(name);
      if (found == frames_.end() || found->second.is_static || name == held_) continue;
      newest_ns = std::min(newest_ns, found->second.history.back().time_ns);
    }
  }
  if (!Lookup(target, source, newest_ns).ok()) return std::nullopt;
  return newest_ns;
}

absl::StatusOr<std::vector<std::string>> TfBuffer::WayUp(const std::string& frame) const {
  std::vector<std::string> way = {frame};
  for (auto at = frames_.find(frame); at != frames_.end(); at = frames_.find(way.back())) {
    const bool loops = std::find(way.begin(), way.end(), at->second.parent) != way.end();
    way.push_back(at->second.parent);
    if (loops) {
      return absl::FailedPreconditionError(
          absl::StrCat("transforms form a loop: ", absl::StrJoin(way, " ← ")));
    }
  }
  return way;
}

std::string TfBuffer::DeadEnds(const std::vector<std::string>& from_up,
                               const std::vector<std::string>& to_up) const {
  const auto hangs = [](const std::vector<std::string>& way) {
    return absl::StrCat(way.front(), " hangs from ", way.back());
  };
  const std::string& to = to_up.front();
  const bool has_children = std::any_of(frames_.begin(), frames_.end(), [&to](const auto& frame) {
    return frame.second.parent == to;
  });
  std::string ends = from_up.size() > 1
                         ? hangs(from_up)
                         : absl::StrCat("nobody says where ", from_up.front(), " is");
  if (to_up.size() > 1) {
    absl::StrAppend(&ends, ", ", hangs(to_up));
  } else if (!has_children) {
    absl::StrAppend(&ends, ", nothing hangs from ", to);
  }
  return ends;
}

absl::StatusOr<Transform> TfBuffer::InParent(const std::string& child, std::int64_t time_ns) const {
  const Frame& frame = frames_.at(child);
  const std::deque<Stamped>& history = frame.history;
  if (frame.is_static || child == held_) return history.back().transform;
  const std::string name = absl::StrCat("transform ", frame.parent, " → ", child);
  if (time_ns > history.back().time_ns) {
    return absl::UnavailableError(absl::StrCat(
        name, " is known up to ", Seconds(history.back().time_ns), ", not at ", Seconds(time_ns)));
  }
  if (time_ns < history.front().time_ns) {
    return absl::OutOfRangeError(absl::StrCat(name, " is known from ",
                                              Seconds(history.front().time_ns), " on, not at ",
                                              Seconds(time_ns)));
  }
  const auto after = std::lower_bound(
      history.begin(), history.end(), time_ns,
      [](const Stamped& stamped, std::int64_t time) { return stamped.time_ns < time; });
  if (after->time_ns == time_ns) return after->transform;
  const auto before = std::prev(after);
  const double share = static_cast<double>(time_ns - before->time_ns) /
                       static_cast<double>(after->time_ns - before->time_ns);
  return Interpolate(before->transform, after->transform, share);
}

absl::StatusOr<Transform> TfBuffer::InAncestor(const std::vector<std::string>& way,
                                               std::size_t steps, std::int64_t time_ns) const {
  Transform in_ancestor;
  for (std::size_t i = 0; i < steps; ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Transform in_parent, InParent(way[i], time_ns));
    in_ancestor = Compose(in_parent, in_ancestor);
  }
  return in_ancestor;
}

absl::StatusOr<Transform> TfBuffer::Lookup(const std::string& target, const std::string& source,
                                           std::int64_t time_ns) const {
  const std::string to = NameOf(target);
  const std::string from = NameOf(source);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<std::string> from_up, WayUp(from));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<std::string> to_up, WayUp(to));
  const auto meeting =
      std::find_first_of(from_up.begin(), from_up.end(), to_up.begin(), to_up.end());
  if (meeting == from_up.end()) {
    return absl::NotFoundError(
        absl::StrCat("no transform ", to, " → ", from, " yet: ", DeadEnds(from_up, to_up)));
  }
  const auto to_meeting = std::find(to_up.begin(), to_up.end(), *meeting);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const Transform from_in_meeting,
      InAncestor(from_up, static_cast<std::size_t>(meeting - from_up.begin()), time_ns));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const Transform to_in_meeting,
      InAncestor(to_up, static_cast<std::size_t>(to_meeting - to_up.begin()), time_ns));
  return Compose(Inverse(to_in_meeting), from_in_meeting);
}

}  // namespace plumescout::client
