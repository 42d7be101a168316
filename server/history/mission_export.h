// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "formats/file_sum.h"
#include "formats/journal/event_codec.h"
#include "formats/journal/journal_file_encoder.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// How much of a mission is exported: as it was after an event.
struct ExportPoint {
  std::int64_t revision = 0;
  std::uint64_t digest = 0;  // Mission::Digest there; 0: not known
};

// A stored mission as a file (formats/journal/journal_file.h), message by message. It reads one
// record at a time and holds one piece. Single-threaded; calls read the disk: not for reactors.
class MissionExport {
 public:
  // As much of a piece as there is before another is begun.
  static constexpr std::size_t kPieceBytes = std::size_t{256} << 10;
  // No piece has more, whatever the records.
  static constexpr std::size_t kMaxPieceBytes = std::size_t{1} << 20;

  // Events up to `point` have to be durable. kNotFound; kDataLoss.
  static absl::StatusOr<std::unique_ptr<MissionExport>> Begin(MissionStore& store,
                                                              const std::string& key,
                                                              const ExportPoint& point);

  // The start, the pieces, the end, and then nothing. kDataLoss, naming the record, if the journal
  // is damaged: the file that has gone out has no end.
  absl::StatusOr<std::optional<v1::ExportMissionResponse>> Next();

 private:
  MissionExport(const JournalStart& start, const ExportPoint& point, std::int64_t expected_bytes,
                std::unique_ptr<JournalReader> reader);

  absl::Status Fill();
  v1::ExportMissionResponse TakePiece();

  enum class Stage { kStart, kPieces, kEnd, kOver };

  const JournalStart start_;
  const ExportPoint point_;
  const std::int64_t expected_bytes_;
  const std::unique_ptr<JournalReader> reader_;
  Stage stage_ = Stage::kStart;
  std::int64_t revision_ = 0;  // of the last event that was read
  JournalFileEncoder encoder_;
  std::string buffer_;  // encoded, not taken
  FileSum sum_;         // of what was taken
};

}  // namespace plumescout::server
