// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/mission_file.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/grpc_reader.h"
#include "client/grpc_status.h"
#include "core/types/status_macros.h"
#include "formats/file_sum.h"
#include "proto/convert/names.h"

namespace plumescout::client {
namespace {

constexpr std::int64_t kMaxPiece_bytes = std::int64_t{1} << 20;
constexpr std::int64_t kFraming_bytes = 4096;  // of a request, beside the bytes of the file

v1::ExportMissionRequest RequestFor(const MissionId& mission, MissionFileFormat format) {
  v1::ExportMissionRequest request;
  request.set_mission(MissionResource(mission));
  request.set_format(format == MissionFileFormat::kMcap ? v1::MISSION_FILE_FORMAT_MCAP
                                                        : v1::MISSION_FILE_FORMAT_JOURNAL);
  return request;
}

// An export on its way in.
class FileReceiver {
 public:
  explicit FileReceiver(const MissionFileSink& sink) : sink_(sink) {}

  // Whether that was the end.
  absl::StatusOr<bool> Take(const v1::ExportMissionResponse& message) {
    switch (message.part_case()) {
      case v1::ExportMissionResponse::kStart:
        start_ = message.start();
        return false;
      case v1::ExportMissionResponse::kPiece:
        PLUMESCOUT_RETURN_IF_ERROR(TakePiece(message.piece()));
        return false;
      case v1::ExportMissionResponse::kEnd:
        if (message.end().total_bytes() != sum_.bytes() ||
            message.end().sha256() != sum_.TakeSha256()) {
          return Damaged();
        }
        return true;
      default:
        return absl::InternalError("the server sent a part that has no place here");
    }
  }

  ExportedMission exported() const {
    return {.revision = start_.revision(), .size_bytes = sum_.bytes()};
  }
  absl::Status Damaged() const {
    return absl::DataLossError(
        absl::StrCat("what came of the file, ", sum_.bytes(), " bytes, is not what was sent"));
  }

 private:
  absl::Status TakePiece(const v1::MissionFilePiece& piece) {
    const std::int64_t offset_bytes = sum_.bytes();
    sum_.Add(piece.data());
    if (piece.offset_bytes() != offset_bytes || piece.crc32() != sum_.crc32()) return Damaged();
    return sink_({.bytes = piece.data(),
                  .offset_bytes = offset_bytes,
                  .expected_bytes = std::max(start_.expected_bytes(), sum_.bytes())});
  }

  const MissionFileSink& sink_;
  v1::MissionFileStart start_;
  FileSum sum_;
};

// Writes the messages of an import; false once the server takes no more.
class FileSender {
 public:
  FileSender(grpc::ClientWriter<v1::ImportMissionRequest>& writer, std::size_t piece_bytes)
      : writer_(writer), piece_bytes_(piece_bytes) {}

  absl::StatusOr<bool> Send(const MissionId& mission, const MissionFileSource& source) {
    v1::ImportMissionRequest request;
    request.mutable_start()->set_mission_id(mission);
    if (!writer_.Write(request)) return false;
    while (true) {
      PLUMESCOUT_ASSIGN_OR_RETURN(std::string bytes, source(piece_bytes_));
      if (bytes.size() > piece_bytes_) {
        return absl::InvalidArgumentError(absl::StrCat("the source gave ", bytes.size(),
                                                       " bytes at once; at most ", piece_bytes_));
      }
      if (bytes.empty()) break;
      if (!SendPiece(std::move(bytes))) return false;
    }
    request.mutable_end()->set_total_bytes(sum_.bytes());
    request.mutable_end()->set_sha256(sum_.TakeSha256());
    return writer_.Write(request) && writer_.WritesDone();
  }

 private:
  bool SendPiece(std::string bytes) {
    v1::ImportMissionRequest request;
    v1::MissionFilePiece& piece = *request.mutable_piece();
    piece.set_offset_bytes(sum_.bytes());
    sum_.Add(bytes);
    piece.set_crc32(sum_.crc32());
    piece.set_data(std::move(bytes));
    return writer_.Write(request);
  }

  grpc::ClientWriter<v1::ImportMissionRequest>& writer_;
  const std::size_t piece_bytes_;
  FileSum sum_;
};

}  // namespace

absl::StatusOr<ExportedMission> ReceiveMissionFile(MissionRoutes& routes,
                                                   v1::SnapshotService::Stub& stub,
                                                   const MissionId& mission,
                                                   MissionFileFormat format,
                                                   const MissionFileSink& sink) {
  GrpcReader<v1::ExportMissionResponse> reader(
      routes, stub, &v1::SnapshotService::Stub::PrepareAsyncExportMission,
      RequestFor(mission, format));
  FileReceiver receiver(sink);
  bool is_whole = false;
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<v1::ExportMissionResponse> message,
                                reader.Read(absl::InfiniteDuration()));
    if (!message) break;
    PLUMESCOUT_ASSIGN_OR_RETURN(is_whole, receiver.Take(*message));
  }
  if (!is_whole) return receiver.Damaged();
  return receiver.exported();
}

absl::StatusOr<MissionId> SendMissionFile(v1::SnapshotService::Stub& stub, const MissionId& mission,
                                          const MissionFileSource& source,
                                          std::int64_t max_request_bytes) {
  const auto piece_bytes = static_cast<std::size_t>(
      std::clamp<std::int64_t>(max_request_bytes - kFraming_bytes, 1, kMaxPiece_bytes));
  grpc::ClientContext context;
  v1::ImportMissionResponse response;
  const auto writer = stub.ImportMission(&context, &response);
  const absl::StatusOr<bool> sent = FileSender(*writer, piece_bytes).Send(mission, source);
  if (!sent.ok()) context.TryCancel();  // before Finish, which waits for the server's word
  const absl::Status status = FromGrpc(writer->Finish());
  if (!sent.ok()) return sent.status();
  if (!status.ok()) return status;
  return FromServer(ParseMissionName("mission.name", response.mission().name()));
}

}  // namespace plumescout::client
