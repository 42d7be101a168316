// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/robot_clocks.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <variant>

#include "core/mission/conduct/clock_offset.h"

namespace plumescout::server {

RobotClocks::Reckoning RobotClocks::Reckon(const RobotId& robot, const BatchTimes& times,
                                           std::int64_t in_force_ns) {
  if (times.sent_ns == 0) {
    estimators_.erase(robot);
    return {};
  }
  const bool is_known = estimators_.contains(robot);
  ClockEstimator& estimator = estimators_[robot];
  const std::int64_t estimate_ns =
      estimator.Note(times.sent_ns, times.arrived_ns, times.at_the_latest);
  const std::int64_t settled_ns = SettledOffset_ns(estimate_ns, in_force_ns);
  const std::int64_t change_ns = std::abs(settled_ns - in_force_ns);
  const bool was_set =
      is_known && change_ns > ClockEstimator::kStep_ns && !estimator.lowered_itself();
  return {settled_ns, was_set};
}

void RobotClocks::NoteBatch(const RobotId& robot, const LinkTimes& link) {
  absl::MutexLock lock(&mutex_);
  links_[robot] = link;
}

void RobotClocks::Forget(const RobotId& robot) {
  estimators_.erase(robot);
  absl::MutexLock lock(&mutex_);
  links_.erase(robot);
}

absl::Duration RobotClocks::WorstOffset() const {
  std::int64_t worst_ns = 0;
  absl::MutexLock lock(&mutex_);
  for (const auto& [robot, link] : links_) worst_ns = std::max(worst_ns, std::abs(link.offset_ns));
  return absl::Nanoseconds(worst_ns);
}

std::optional<LinkTimes> RobotClocks::LinkOf(const RobotId& robot) const {
  absl::MutexLock lock(&mutex_);
  const auto found = links_.find(robot);
  if (found == links_.end()) return std::nullopt;
  return found->second;
}

std::vector<IncomingObservation> TakeMadeBefore(std::int64_t moved_ns, std::int64_t sent_ns,
                                                std::vector<IncomingObservation>& batch) {
  const auto time_ns = [](const IncomingObservation& incoming) {
    return incoming.observation.sample_time_ns;
  };
  const auto has_time = [](const IncomingObservation& incoming) {
    return incoming.unreadable.ok() &&
           !std::holds_alternative<SequenceGap>(incoming.observation.payload);
  };
  std::size_t first_after = 0;  // the clock was set
  std::optional<std::int64_t> before_ns;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (!has_time(batch[i])) continue;
    const std::int64_t leap_ns = time_ns(batch[i]) - before_ns.value_or(time_ns(batch[i]));
    const bool leaps = moved_ns > 0 ? leap_ns > moved_ns / 2 : leap_ns < moved_ns / 2;
    if (leaps) first_after = i;
    if (time_ns(batch[i]) > sent_ns + ClockEstimator::kStep_ns) first_after = i + 1;
    before_ns = time_ns(batch[i]);
  }
  const auto end = batch.begin() + static_cast<std::ptrdiff_t>(first_after);
  std::vector<IncomingObservation> earlier(std::make_move_iterator(batch.begin()),
                                           std::make_move_iterator(end));
  batch.erase(batch.begin(), end);
  return earlier;
}

}  // namespace plumescout::server
