// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/mission_export.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"
#include "core/types/status_macros.h"
#include "proto/convert/names.h"
#include "server/base/clock.h"

namespace plumescout::server {
namespace {

// Beside the event itself, a file has lengths and checksums.
constexpr std::int64_t kBytesBesideRecord = 12;
// A call ends after so much: others wait for the pool's thread.
constexpr absl::Duration kMaxFillTime = absl::Milliseconds(100);
constexpr double kMapPeriod_s = 10.0;

absl::StatusOr<std::int64_t> BytesOf(MissionStore& store, const std::string& key) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto missions, store.List());
  for (const StoredMission& mission : missions) {
    if (mission.key == key) return mission.bytes + mission.head * kBytesBesideRecord;
  }
  return absl::NotFoundError(absl::StrCat("mission ", key, " is not stored"));
}

}  // namespace

absl::StatusOr<std::unique_ptr<MissionExport>> MissionExport::Begin(MissionStore& store,
                                                                    const std::string& key,
                                                                    const ExportPoint& point,
                                                                    const MakePast& make_past) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const AcquiredMission stored, store.Peek(key));
  PLUMESCOUT_ASSIGN_OR_RETURN(JournalStart start, DecodeStart(stored.header));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::int64_t bytes, BytesOf(store, key));
  if (stored.first > 1) {
    return absl::FailedPreconditionError(
        absl::StrCat("mission ", key, " keeps no events up to ", stored.first - 1,
                     " any more (event_retention), and an export needs them all"));
  }
  start.last_number = point.revision;
  start.last_digest = point.digest;
  std::unique_ptr<JournalReader> reader;
  if (point.revision > 0) {
    PLUMESCOUT_ASSIGN_OR_RETURN(reader, store.Read(key, 1));
  }
  PastMission past;
  if (make_past) {
    PLUMESCOUT_ASSIGN_OR_RETURN(past, make_past());
  }
  return std::unique_ptr<MissionExport>(
      new MissionExport(start, point, bytes, std::move(reader), std::move(past)));
}

MissionExport::MissionExport(const JournalStart& start, const ExportPoint& point,
                             std::int64_t expected_bytes, std::unique_ptr<JournalReader> reader,
                             PastMission past)
    : start_(start),
      point_(point),
      expected_bytes_(expected_bytes),
      reader_(std::move(reader)),
      room_(std::move(past.room)),
      mcap_(past.mission == nullptr
                ? nullptr
                : std::make_unique<MissionMcap>(start, std::move(past.mission), kMapPeriod_s)) {}

absl::StatusOr<std::optional<v1::ExportMissionResponse>> MissionExport::Next() {
  std::optional<v1::ExportMissionResponse> response(std::in_place);
  switch (stage_) {
    case Stage::kStart: {
      v1::MissionFileStart& start = *response->mutable_start();
      start.set_mission(MissionResource(start_.mission));
      start.set_revision(point_.revision);
      start.set_expected_bytes(expected_bytes_);
      if (mcap_ == nullptr) buffer_ = encoder_.Begin(start_);
      stage_ = Stage::kPieces;
      return response;
    }
    case Stage::kPieces:
      PLUMESCOUT_RETURN_IF_ERROR(Fill());
      if (!buffer_.empty()) *response = TakePiece();
      if (buffer_.empty() && closed_) stage_ = Stage::kEnd;
      return response;
    case Stage::kEnd:
      mcap_.reset();
      room_.reset();
      response->mutable_end()->set_total_bytes(sum_.bytes());
      response->mutable_end()->set_sha256(sum_.TakeSha256());
      stage_ = Stage::kOver;
      return response;
    case Stage::kOver:
      break;
  }
  return std::optional<v1::ExportMissionResponse>();
}

absl::Status MissionExport::Fill() {
  const SteadyTime until = After(SteadyNow(), kMaxFillTime);
  while (buffer_.size() < kPieceBytes && revision_ < point_.revision && SteadyNow() < until) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<JournalRecord> record, reader_->Next());
    if (!record.has_value() || record->number != revision_ + 1) {
      return Damaged(revision_ + 1, " is missing in the journal");
    }
    PLUMESCOUT_RETURN_IF_ERROR(Add(*record));
    ++revision_;
  }
  return revision_ == point_.revision && !closed_ ? Close() : absl::OkStatus();
}

absl::Status MissionExport::Add(const JournalRecord& record) {
  if (mcap_ == nullptr) {
    buffer_ += encoder_.Record(record.bytes);
    return absl::OkStatus();
  }
  const absl::StatusOr<Event> event = DecodeEvent(record.bytes);
  if (!event.ok()) return Damaged(record.number, absl::StrCat(": ", event.status().message()));
  const absl::Status added = mcap_->Add(*event, record.bytes);
  if (absl::IsDataLoss(added)) return Damaged(record.number, absl::StrCat(": ", added.message()));
  buffer_ += mcap_->Take();
  return added;
}

absl::Status MissionExport::Close() {
  closed_ = true;
  if (mcap_ == nullptr) return absl::OkStatus();
  if (point_.digest != 0 && mcap_->mission().Digest() != point_.digest) {
    return Damaged(revision_, ": replayed, this is another mission");
  }
  PLUMESCOUT_RETURN_IF_ERROR(mcap_->Finish());
  buffer_ += mcap_->Take();
  return absl::OkStatus();
}

absl::Status MissionExport::Damaged(std::int64_t number, absl::string_view why) const {
  return TypedError(absl::StatusCode::kDataLoss, reason::kStoreDamaged,
                    absl::StrCat("event ", number, " of mission ", start_.mission, why));
}

v1::ExportMissionResponse MissionExport::TakePiece() {
  v1::ExportMissionResponse response;
  v1::MissionFilePiece& piece = *response.mutable_piece();
  const std::size_t size = std::min(buffer_.size(), kMaxPieceBytes);
  piece.set_offset_bytes(sum_.bytes());
  piece.set_data(buffer_.substr(0, size));
  buffer_.erase(0, size);
  sum_.Add(piece.data());
  piece.set_crc32(sum_.crc32());
  return response;
}

}  // namespace plumescout::server
