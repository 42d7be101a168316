// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_log.h"

#include <algorithm>
#include <utility>

namespace plumescout::client {
namespace {

std::size_t Footprint_bytes(const Observation& observation) {
  std::size_t heap_bytes = 0;
  if (const auto* scan = std::get_if<Scan>(&observation.payload)) {
    heap_bytes = scan->ranges_m.capacity() * sizeof(float);
  } else if (const auto* correction = std::get_if<PoseCorrection>(&observation.payload)) {
    heap_bytes = correction->anchors.capacity() * sizeof(PoseAnchor);
  }
  return sizeof(Observation) + heap_bytes;
}

bool IsGap(const Observation& entry) { return std::holds_alternative<SequenceGap>(entry.payload); }

// Told as of the time and place of another entry.
Observation MakeGap(std::int64_t first_sequence, std::int64_t last_sequence,
                    const Observation& beside) {
  return {.sequence = first_sequence,
          .sample_time_ns = beside.sample_time_ns,
          .pose = beside.pose,
          .payload = SequenceGap{first_sequence, last_sequence}};
}

// The part of a gap from `first_sequence` on.
void CutGap(std::int64_t first_sequence, Observation& gap) {
  gap.sequence = first_sequence;
  std::get<SequenceGap>(gap.payload).first_sequence = first_sequence;
}

void Shift(std::int64_t by, Observation& entry) {
  entry.sequence += by;
  if (auto* gap = std::get_if<SequenceGap>(&entry.payload)) {
    gap->first_sequence += by;
    gap->last_sequence += by;
  }
}

}  // namespace

RobotLog::RobotLog(const RobotLogOptions& options, std::int64_t last_sequence)
    : options_(options), last_sequence_(last_sequence), applied_sequence_(last_sequence) {
  options_.max_observations = std::max<std::size_t>(options_.max_observations, 1);
}

void RobotLog::Restore(KeptLog kept) {
  for (Observation& entry : kept.entries) {
    if (!entries_.empty()) PushGap(entry.sequence - 1);
    Push(std::move(entry));
  }
  SkipTo(kept.last_sequence);
  while (Full()) DropOldest();
  Acknowledge(kept.applied_sequence, kept.durable_sequence);
  lost_observations_ = 0;  // what this process lost
}

std::int64_t RobotLog::Append(std::int64_t sample_time_ns, const Pose2& pose,
                              ObservationPayload payload) {
  Push({.sequence = last_sequence_ + 1,
        .sample_time_ns = sample_time_ns,
        .pose = pose,
        .payload = std::move(payload)});
  while (Full()) DropOldest();
  return last_sequence_;
}

void RobotLog::Acknowledge(std::int64_t applied_sequence, std::int64_t durable_sequence) {
  applied_sequence_ = applied_sequence;
  durable_sequence_ = durable_sequence;
  CountDurable();
  while (durable_bytes_ > options_.max_durable_bytes) DropOldest();
}

void RobotLog::SkipTo(std::int64_t sequence) {
  if (!entries_.empty()) PushGap(sequence);
  last_sequence_ = std::max(last_sequence_, sequence);
}

Renumbering RobotLog::RebaseAfter(std::int64_t sequence) {
  while (!entries_.empty() &&
         (IsGap(entries_.front()) || entries_.front().sequence <= applied_sequence_)) {
    DropOldest();
  }
  const Renumbering renumbering{.from = first_held_sequence(), .to = sequence + 1};
  const std::int64_t by = renumbering.to - renumbering.from;
  for (Observation& entry : entries_) Shift(by, entry);
  last_sequence_ += by;
  Acknowledge(sequence, 0);
  return renumbering;
}

std::vector<Observation> RobotLog::Read(std::int64_t first_sequence,
                                        const ReadLimits& limits) const {
  std::vector<Observation> batch;
  if (first_sequence > std::min(last_sequence_, limits.through_sequence)) return batch;
  if (entries_.empty()) {
    if (latest_.has_value()) batch.push_back(MakeGap(first_sequence, last_sequence_, *latest_));
    return batch;
  }
  if (first_sequence < first_held_sequence()) {
    batch.push_back(MakeGap(first_sequence, first_held_sequence() - 1, entries_.front()));
    first_sequence = first_held_sequence();
  }
  std::size_t batch_bytes = batch.size() * sizeof(Observation);
  auto entry = std::partition_point(
      entries_.begin(), entries_.end(),
      [first_sequence](const Observation& held) { return LastSequence(held) < first_sequence; });
  for (; entry != entries_.end() && entry->sequence <= limits.through_sequence; ++entry) {
    batch_bytes += Footprint_bytes(*entry);
    const bool room = batch.size() < limits.max_observations && batch_bytes <= limits.max_bytes;
    if (!room && !batch.empty()) break;
    batch.push_back(*entry);
    if (entry->sequence < first_sequence) CutGap(first_sequence, batch.back());
  }
  return batch;
}

void RobotLog::Push(Observation entry) {
  last_sequence_ = LastSequence(entry);
  if (!latest_.has_value()) latest_.emplace();
  latest_->sample_time_ns = entry.sample_time_ns;
  latest_->pose = entry.pose;
  bytes_ += Footprint_bytes(entry);
  entries_.push_back(std::move(entry));
}

void RobotLog::PushGap(std::int64_t last_sequence) {
  if (last_sequence <= last_sequence_) return;
  Push(MakeGap(last_sequence_ + 1, last_sequence, entries_.back()));
}

void RobotLog::CountDurable() {
  while (durable_count_ < entries_.size() &&
         LastSequence(entries_[durable_count_]) <= durable_sequence_) {
    durable_bytes_ += Footprint_bytes(entries_[durable_count_++]);
  }
  while (durable_count_ > 0 && LastSequence(entries_[durable_count_ - 1]) > durable_sequence_) {
    durable_bytes_ -= Footprint_bytes(entries_[--durable_count_]);
  }
}

bool RobotLog::Full() const {
  return entries_.size() > 1 &&
         (entries_.size() > options_.max_observations || bytes_ > options_.max_bytes);
}

void RobotLog::DropOldest() {
  const Observation& oldest = entries_.front();
  if (oldest.sequence > applied_sequence_ && !IsGap(oldest)) ++lost_observations_;
  bytes_ -= Footprint_bytes(oldest);
  if (durable_count_ > 0) {
    --durable_count_;
    durable_bytes_ -= Footprint_bytes(oldest);
  }
  entries_.pop_front();
}

}  // namespace plumescout::client
