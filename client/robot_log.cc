// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_log.h"

#include <algorithm>
#include <utility>

namespace plumescout::client {
namespace {

std::size_t Footprint_bytes(const Observation& observation) {
  const auto* scan = std::get_if<Scan>(&observation.payload);
  const std::size_t heap_bytes = scan != nullptr ? scan->ranges_m.capacity() * sizeof(float) : 0;
  return sizeof(Observation) + heap_bytes;
}

Observation MakeGap(std::int64_t first_sequence, const Observation& next) {
  return {.sequence = first_sequence,
          .sample_time_ns = next.sample_time_ns,
          .pose = next.pose,
          .payload = SequenceGap{first_sequence, next.sequence - 1}};
}

}  // namespace

RobotLog::RobotLog(const RobotLogOptions& options, std::int64_t last_sequence)
    : options_(options), last_sequence_(last_sequence), applied_sequence_(last_sequence) {
  options_.max_observations = std::max<std::size_t>(options_.max_observations, 1);
}

std::int64_t RobotLog::Append(std::int64_t sample_time_ns, const Pose2& pose,
                              std::variant<Scan, GasReading> payload) {
  Observation entry{
      .sequence = ++last_sequence_, .sample_time_ns = sample_time_ns, .pose = pose, .payload = {}};
  std::visit([&entry](auto&& seen) { entry.payload = std::forward<decltype(seen)>(seen); },
             std::move(payload));
  bytes_ += Footprint_bytes(entry);
  entries_.push_back(std::move(entry));
  while (Full()) DropOldest();
  return last_sequence_;
}

void RobotLog::Acknowledge(std::int64_t applied_sequence, std::int64_t durable_sequence) {
  applied_sequence_ = applied_sequence;
  while (!entries_.empty() && entries_.front().sequence <= durable_sequence) DropOldest();
}

std::vector<Observation> RobotLog::Read(std::int64_t first_sequence,
                                        const ReadLimits& limits) const {
  std::vector<Observation> batch;
  if (entries_.empty() || first_sequence > std::min(last_sequence_, limits.through_sequence)) {
    return batch;
  }
  std::size_t batch_bytes = 0;
  if (first_sequence < first_held_sequence()) {
    batch.push_back(MakeGap(first_sequence, entries_.front()));
    batch_bytes += Footprint_bytes(batch.back());
    first_sequence = first_held_sequence();
  }
  auto entry = entries_.begin() + (first_sequence - first_held_sequence());
  for (; entry != entries_.end() && entry->sequence <= limits.through_sequence; ++entry) {
    batch_bytes += Footprint_bytes(*entry);
    const bool room = batch.size() < limits.max_observations && batch_bytes <= limits.max_bytes;
    if (!room && !batch.empty()) break;
    batch.push_back(*entry);
  }
  return batch;
}

bool RobotLog::Full() const {
  return entries_.size() > 1 &&
         (entries_.size() > options_.max_observations || bytes_ > options_.max_bytes);
}

void RobotLog::DropOldest() {
  const Observation& oldest = entries_.front();
  if (oldest.sequence > applied_sequence_) ++lost_observations_;
  bytes_ -= Footprint_bytes(oldest);
  entries_.pop_front();
}

}  // namespace plumescout::client
