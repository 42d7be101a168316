// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "formats/file_sum.h"
#include "formats/journal/event_codec.h"
#include "formats/journal/journal_file_encoder.h"
#include "formats/view/mission_mcap.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "server/history/past_missions.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// How much of a mission is exported: as it was after an event.
struct ExportPoint {
  std::int64_t revision = 0;
  std::uint64_t digest = 0;  // Mission::Digest there; 0: not known
};

// A stored mission as a file, message by message: a journal (formats/journal/journal_file.h), or
// MCAP (formats/view/mission_mcap.h), for which it is replayed. It reads one record at a time and
// holds one piece, of MCAP also the mission and a chunk. Single-threaded; calls read the disk: not
// for reactors.
class MissionExport {
 public:
  // As much of a piece as there is before another is begun.
  static constexpr std::size_t kPieceBytes = std::size_t{256} << 10;
  // No piece has more, whatever the records.
  static constexpr std::size_t kMaxPieceBytes = std::size_t{1} << 20;

  // The mission before its first event.
  using MakePast = std::function<absl::StatusOr<PastMission>()>;

  // Events up to `point` have to be durable. With `make_past` the file is MCAP. kNotFound;
  // kDataLoss; kFailedPrecondition if not all events are kept; those of `make_past`.
  static absl::StatusOr<std::unique_ptr<MissionExport>> Begin(MissionStore& store,
                                                              const std::string& key,
                                                              const ExportPoint& point,
                                                              const MakePast& make_past = {});

  // The start, the pieces, the end, and then nothing. Some 0.1 s go into a call at most: a message
  // of nothing says that the next piece is not ready. kDataLoss, naming the record, if the journal
  // is damaged or makes another mission: the file that has gone out has no end.
  absl::StatusOr<std::optional<v1::ExportMissionResponse>> Next();

 private:
  MissionExport(const JournalStart& start, const ExportPoint& point, std::int64_t expected_bytes,
                std::unique_ptr<JournalReader> reader, PastMission past);

  absl::Status Fill();
  absl::Status Add(const JournalRecord& record);
  absl::Status Close();
  absl::Status Damaged(std::int64_t number, absl::string_view why) const;
  v1::ExportMissionResponse TakePiece();

  enum class Stage { kStart, kPieces, kEnd, kOver };

  const JournalStart start_;
  const ExportPoint point_;
  const std::int64_t expected_bytes_;
  const std::unique_ptr<JournalReader> reader_;
  // Both are let go before the end goes out, so that who has it may ask for the next.
  std::shared_ptr<void> room_;         // of the mission that is replayed
  std::unique_ptr<MissionMcap> mcap_;  // null: a journal
  Stage stage_ = Stage::kStart;
  std::int64_t revision_ = 0;  // of the last event that was read
  JournalFileEncoder encoder_;
  bool closed_ = false;  // all that the file has is encoded
  std::string buffer_;   // encoded, not taken
  FileSum sum_;          // of what was taken
};

}  // namespace plumescout::server
