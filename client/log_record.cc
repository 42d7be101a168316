// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/log_record.h"

#include <initializer_list>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/crc32c.h"
#include "proto/convert/observation.h"

namespace plumescout::client {
namespace {

constexpr absl::string_view kSegmentMagic = "PLUMELOG";
constexpr std::size_t kRecordHead_bytes = 8;                    // length and checksum
constexpr std::size_t kMaxRecord_bytes = std::size_t{1} << 20;  // more than any observation

enum class RecordKind : char { kHead = 1, kObservation = 2, kMark = 3, kRenumbering = 4 };

template <typename Number>
void PutNumber(Number number, std::string& bytes) {
  auto rest = static_cast<std::uint64_t>(number);
  for (std::size_t i = 0; i < sizeof(Number); ++i, rest >>= 8) {
    bytes.push_back(static_cast<char>(rest & 0xFFU));
  }
}

void PutText(absl::string_view text, std::string& bytes) {
  PutNumber(static_cast<std::uint32_t>(text.size()), bytes);
  absl::StrAppend(&bytes, text);
}

// Takes what was put from the front of `bytes`; false if they end too early.
template <typename Number>
bool TakeNumber(absl::string_view& bytes, Number& number) {
  if (bytes.size() < sizeof(Number)) return false;
  std::uint64_t taken = 0;
  for (std::size_t i = sizeof(Number); i-- > 0;) {
    taken = taken << 8 | static_cast<unsigned char>(bytes[i]);
  }
  number = static_cast<Number>(taken);
  bytes.remove_prefix(sizeof(Number));
  return true;
}

bool TakeText(absl::string_view& bytes, std::string& text) {
  std::uint32_t size = 0;
  if (!TakeNumber(bytes, size) || bytes.size() < size) return false;
  text = std::string(bytes.substr(0, size));
  bytes.remove_prefix(size);
  return true;
}

bool TakeNumbers(absl::string_view& bytes, std::initializer_list<std::int64_t*> numbers) {
  for (std::int64_t* number : numbers) {
    if (!TakeNumber(bytes, *number)) return false;
  }
  return true;
}

std::string BodyOf(const SegmentHead& head) {
  std::string body(1, static_cast<char>(RecordKind::kHead));
  for (const std::int64_t number : {head.epoch, head.last_sequence, head.applied_sequence,
                                    head.durable_sequence, head.renumberings}) {
    PutNumber(number, body);
  }
  PutText(head.mission, body);
  PutText(head.robot, body);
  return body;
}

v1::Observation GapAt(std::int64_t sequence) {
  return ToProto(Observation{.sequence = sequence,
                             .sample_time_ns = 0,
                             .pose = {},
                             .payload = SequenceGap{sequence, sequence}});
}

std::string BodyOf(const Observation& observation) {
  std::string body(1, static_cast<char>(RecordKind::kObservation));
  v1::Observation proto = ToProto(observation);
  if (proto.ByteSizeLong() >= kMaxRecord_bytes) proto = GapAt(observation.sequence);
  proto.AppendToString(&body);
  return body;
}

std::string BodyOf(const LogMark& mark) {
  std::string body(1, static_cast<char>(RecordKind::kMark));
  PutNumber(mark.applied_sequence, body);
  PutNumber(mark.durable_sequence, body);
  return body;
}

std::string BodyOf(const NumberedRenumbering& numbered) {
  std::string body(1, static_cast<char>(RecordKind::kRenumbering));
  PutNumber(numbered.number, body);
  PutNumber(numbered.renumbering.from, body);
  PutNumber(numbered.renumbering.to, body);
  return body;
}

absl::StatusOr<LogRecord> ReadObservation(absl::string_view bytes) {
  v1::Observation proto;
  if (!proto.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return absl::DataLossError("no observation");
  }
  absl::StatusOr<Observation> observation = FromProto(proto, "observation");
  if (!observation.ok()) observation = FromProto(GapAt(proto.sequence()), "observation");
  if (!observation.ok()) return absl::DataLossError(observation.status().message());
  return LogRecord(*std::move(observation));
}

absl::StatusOr<LogRecord> ReadBody(absl::string_view body) {
  const char kind = body.front();
  body.remove_prefix(1);
  bool whole = false;
  LogRecord record;
  switch (static_cast<RecordKind>(kind)) {
    case RecordKind::kHead: {
      SegmentHead head;
      whole = TakeNumbers(body, {&head.epoch, &head.last_sequence, &head.applied_sequence,
                                 &head.durable_sequence, &head.renumberings}) &&
              TakeText(body, head.mission) && TakeText(body, head.robot);
      record = std::move(head);
      break;
    }
    case RecordKind::kObservation:
      return ReadObservation(body);
    case RecordKind::kMark: {
      LogMark mark;
      whole = TakeNumbers(body, {&mark.applied_sequence, &mark.durable_sequence});
      record = mark;
      break;
    }
    case RecordKind::kRenumbering: {
      NumberedRenumbering numbered;
      whole = TakeNumbers(body,
                          {&numbered.number, &numbered.renumbering.from, &numbered.renumbering.to});
      record = numbered;
      break;
    }
  }
  if (!whole || !body.empty()) {
    return absl::DataLossError(
        absl::StrCat("a record of kind ", static_cast<int>(kind), " that cannot be read"));
  }
  return record;
}

}  // namespace

std::string SegmentPreamble() {
  std::string bytes(kSegmentMagic);
  PutNumber(kSegmentVersion, bytes);
  return bytes;
}

absl::StatusOr<std::size_t> CheckPreamble(absl::string_view bytes) {
  const std::size_t size = kSegmentMagic.size() + sizeof(kSegmentVersion);
  if (!absl::StartsWith(kSegmentMagic, bytes.substr(0, kSegmentMagic.size()))) {
    return absl::FailedPreconditionError("is no robot's log");
  }
  if (bytes.size() < size) return absl::OutOfRangeError("ends in its preamble");
  std::uint32_t version = 0;
  bytes.remove_prefix(kSegmentMagic.size());
  TakeNumber(bytes, version);
  if (version != kSegmentVersion) {
    return absl::FailedPreconditionError(
        absl::StrCat("is of version ", version, "; this program knows ", kSegmentVersion));
  }
  return size;
}

std::string EncodeRecord(const LogRecord& record) {
  const std::string body = std::visit([](const auto& kind) { return BodyOf(kind); }, record);
  std::string bytes;
  PutNumber(static_cast<std::uint32_t>(body.size()), bytes);
  PutNumber(Crc32c(body, Crc32c(bytes)), bytes);
  return absl::StrCat(bytes, body);
}

absl::StatusOr<DecodedRecord> DecodeRecord(absl::string_view bytes) {
  absl::string_view rest = bytes;
  std::uint32_t size = 0;
  std::uint32_t checksum = 0;
  if (!TakeNumber(rest, size) || !TakeNumber(rest, checksum)) {
    return absl::OutOfRangeError("ends in the head of a record");
  }
  if (size < 1 || size > kMaxRecord_bytes) {
    return absl::DataLossError(absl::StrCat("a record of ", size, " bytes"));
  }
  if (rest.size() < size) return absl::OutOfRangeError("ends in a record");
  const absl::string_view body = rest.substr(0, size);
  if (Crc32c(body, Crc32c(bytes.substr(0, sizeof(size)))) != checksum) {
    return absl::DataLossError("a record with a wrong checksum");
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(LogRecord record, ReadBody(body));
  return DecodedRecord{std::move(record), kRecordHead_bytes + size};
}

std::size_t RecordSize_bytes(absl::string_view bytes) {
  const std::size_t held_bytes = bytes.size();
  std::uint32_t body_bytes = 0;
  if (held_bytes < kRecordHead_bytes || !TakeNumber(bytes, body_bytes)) return 0;
  const std::size_t size_bytes = kRecordHead_bytes + body_bytes;
  return body_bytes <= kMaxRecord_bytes && size_bytes <= held_bytes ? size_bytes : 0;
}

}  // namespace plumescout::client
