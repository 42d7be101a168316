// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/log_replay.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::client {

LogReplay::LogReplay(MissionId mission, RobotId robot)
    : mission_(std::move(mission)), robot_(std::move(robot)) {}

SegmentEnd LogReplay::Read(absl::string_view segment) {
  SegmentEnd end;
  const absl::StatusOr<std::size_t> preamble_bytes = CheckPreamble(segment);
  if (!preamble_bytes.ok()) {
    end.status = preamble_bytes.status();
    return end;
  }
  for (std::size_t at = *preamble_bytes; at < segment.size(); at = end.good_bytes) {
    const std::size_t lost_before_bytes = end.lost_bytes;
    const absl::StatusOr<std::size_t> size_bytes = ReadRecord(segment.substr(at), end);
    if (!size_bytes.ok()) end.lost_bytes += segment.size() - at;
    if (end.lost_bytes > lost_before_bytes && lost_before_bytes == 0) end.damage_bytes = at;
    if (!size_bytes.ok()) {
      end.status.Update(size_bytes.status());
      return end;
    }
    end.good_bytes = at + *size_bytes;
  }
  if (end.good_bytes == 0) end.status = absl::OutOfRangeError("ends before its head");
  return end;
}

absl::StatusOr<std::size_t> LogReplay::ReadRecord(absl::string_view rest, SegmentEnd& end) {
  absl::StatusOr<DecodedRecord> decoded = DecodeRecord(rest);
  if (!decoded.ok()) {
    const std::size_t size_bytes = RecordSize_bytes(rest);
    const bool skip = absl::IsDataLoss(decoded.status()) && end.good_bytes > 0 && size_bytes > 0 &&
                      DecodeRecord(rest.substr(size_bytes)).ok();
    if (!skip) return decoded.status();
    end.status.Update(decoded.status());
    end.lost_bytes += size_bytes;
    return size_bytes;
  }
  if (std::holds_alternative<SegmentHead>(decoded->record) != (end.good_bytes == 0)) {
    return absl::DataLossError("a head in the wrong place");
  }
  PLUMESCOUT_RETURN_IF_ERROR(
      std::visit([&](auto& record) { return Take(std::move(record), end); }, decoded->record));
  return decoded->size_bytes;
}

absl::Status LogReplay::Take(const SegmentHead& head, SegmentEnd&) {
  if (head.mission != mission_ || head.robot != robot_) {
    return absl::FailedPreconditionError(absl::StrCat("is of the log of robot \"", head.robot,
                                                      "\" in mission \"", head.mission, "\""));
  }
  if (log_.epoch != 0 && head.epoch != log_.epoch) {
    return absl::DataLossError("a segment of another log of this robot");
  }
  const bool first = log_.epoch == 0;
  if (!first && head.renumberings > renumberings_) {  // one was lost: who was who cannot be told
    log_.entries.clear();
    log_.last_sequence = 0;
  }
  log_.epoch = head.epoch;
  renumberings_ = std::max(renumberings_, head.renumberings);
  log_.last_sequence = std::max(log_.last_sequence, head.last_sequence);
  log_.applied_sequence = head.applied_sequence;
  log_.durable_sequence = head.durable_sequence;
  return absl::OkStatus();
}

absl::Status LogReplay::Take(Observation observation, SegmentEnd&) {
  // What a sync failed for is written again.
  const bool known =
      !log_.entries.empty() && observation.sequence <= LastSequence(log_.entries.back());
  if (known) return absl::OkStatus();
  log_.last_sequence = std::max(log_.last_sequence, LastSequence(observation));
  log_.entries.push_back(std::move(observation));
  return absl::OkStatus();
}

absl::Status LogReplay::Take(const LogMark& mark, SegmentEnd&) {
  log_.applied_sequence = mark.applied_sequence;
  log_.durable_sequence = mark.durable_sequence;
  return absl::OkStatus();
}

absl::Status LogReplay::Take(const NumberedRenumbering& numbered, SegmentEnd& end) {
  if (numbered.number <= renumberings_) return absl::OkStatus();
  const Renumbering& renumbering = numbered.renumbering;
  const std::int64_t by = renumbering.to - renumbering.from;
  auto& entries = log_.entries;
  entries.erase(
      std::remove_if(entries.begin(), entries.end(),
                     [&](const Observation& entry) { return entry.sequence < renumbering.from; }),
      entries.end());
  for (Observation& entry : entries) {
    entry.sequence += by;
    if (auto* gap = std::get_if<SequenceGap>(&entry.payload)) {
      *gap = {gap->first_sequence + by, gap->last_sequence + by};
    }
  }
  log_.last_sequence = std::max(log_.last_sequence, renumbering.from - 1) + by;
  log_.applied_sequence = renumbering.to - 1;
  log_.durable_sequence = 0;
  renumberings_ = numbered.number;
  end.renumberings.push_back(renumbering);
  return absl::OkStatus();
}

}  // namespace plumescout::client
