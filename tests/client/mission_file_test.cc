// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/mission_file.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "formats/file_sum.h"

namespace plumescout::client {
namespace mission_file_test {

constexpr auto kJournal = MissionFileFormat::kJournal;
constexpr char kFile[] = "the events of a mission, one after the other";

// Exports kFile in two pieces, and imports what comes.
class FileService final : public v1::SnapshotService::Service {
 public:
  FileService() {
    grpc::ServerBuilder builder;
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    stub = v1::SnapshotService::NewStub(server_->InProcessChannel({}));
  }
  ~FileService() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status ExportMission(grpc::ServerContext*, const v1::ExportMissionRequest* request,
                             grpc::ServerWriter<v1::ExportMissionResponse>* writer) override {
    asked_format = request->format();
    v1::ExportMissionResponse message;
    message.mutable_start()->set_revision(9);
    message.mutable_start()->set_expected_bytes(1000);
    writer->Write(message);
    FileSum sum;
    for (const std::string& piece :
         {std::string(kFile).substr(0, 5), std::string(kFile).substr(5)}) {
      message.mutable_piece()->set_offset_bytes(sum.bytes());
      sum.Add(piece);
      message.mutable_piece()->set_crc32(sum.crc32() + crc_error);
      message.mutable_piece()->set_data(piece);
      writer->Write(message);
    }
    if (ends_early) return grpc::Status::OK;
    message.mutable_end()->set_total_bytes(sum.bytes());
    message.mutable_end()->set_sha256(sum.TakeSha256());
    writer->Write(message);
    return grpc::Status::OK;
  }
  grpc::Status ImportMission(grpc::ServerContext*,
                             grpc::ServerReader<v1::ImportMissionRequest>* reader,
                             v1::ImportMissionResponse* response) override {
    v1::ImportMissionRequest request;
    while (reader->Read(&request)) {
      if (request.has_start())
        response->mutable_mission()->set_name("missions/" + request.start().mission_id());
      if (request.has_piece()) {
        EXPECT_EQ(request.piece().offset_bytes(), static_cast<std::int64_t>(imported.size()));
        imported += request.piece().data();
        ++pieces;
      }
      if (request.has_end()) end = request.end();
      if (refuses) return grpc::Status(grpc::StatusCode::ALREADY_EXISTS, "it is there");
    }
    return grpc::Status::OK;
  }

  MissionRoutes routes;
  std::unique_ptr<v1::SnapshotService::Stub> stub;
  v1::MissionFileFormat asked_format = v1::MISSION_FILE_FORMAT_UNSPECIFIED;
  std::uint32_t crc_error = 0;
  bool ends_early = false;
  bool refuses = false;
  std::string imported;
  int pieces = 0;
  v1::MissionFileEnd end;

 private:
  std::unique_ptr<grpc::Server> server_;
};

MissionFileSink Into(std::string& file) {
  return [&file](const MissionFilePiece& piece) {
    EXPECT_EQ(piece.offset_bytes, static_cast<std::int64_t>(file.size()));
    EXPECT_EQ(piece.expected_bytes, 1000);
    file.append(piece.bytes.data(), piece.bytes.size());
    return absl::OkStatus();
  };
}

MissionFileSource From(std::string& file) {
  return [&file](std::size_t max_bytes) {
    const std::string piece = file.substr(0, max_bytes);
    file.erase(0, piece.size());
    return piece;
  };
}

TEST(MissionFileTest, AnExportComesWhole) {
  FileService service;
  std::string file;
  const auto exported =
      ReceiveMissionFile(service.routes, *service.stub, "house", kJournal, Into(file));
  ASSERT_TRUE(exported.ok()) << exported.status();
  EXPECT_EQ(file, kFile);
  EXPECT_EQ(exported->revision, 9);
  EXPECT_EQ(exported->size_bytes, static_cast<std::int64_t>(file.size()));
  EXPECT_EQ(service.asked_format, v1::MISSION_FILE_FORMAT_JOURNAL);
  file.clear();
  ASSERT_TRUE(ReceiveMissionFile(service.routes, *service.stub, "house", MissionFileFormat::kMcap,
                                 Into(file))
                  .ok());
  EXPECT_EQ(service.asked_format, v1::MISSION_FILE_FORMAT_MCAP);
}

TEST(MissionFileTest, WhatIsNotWhatWasSentIsNotTaken) {
  FileService service;
  std::string file;
  service.crc_error = 1;
  EXPECT_TRUE(absl::IsDataLoss(
      ReceiveMissionFile(service.routes, *service.stub, "house", kJournal, Into(file)).status()));
  EXPECT_EQ(file, "");
  service.crc_error = 0;
  service.ends_early = true;
  EXPECT_TRUE(absl::IsDataLoss(
      ReceiveMissionFile(service.routes, *service.stub, "house", kJournal, Into(file)).status()));
}

TEST(MissionFileTest, ASinkThatIsFullEndsTheExport) {
  FileService service;
  const auto full = [](const MissionFilePiece&) { return absl::ResourceExhaustedError("full"); };
  EXPECT_TRUE(absl::IsResourceExhausted(
      ReceiveMissionFile(service.routes, *service.stub, "house", kJournal, full).status()));
}

TEST(MissionFileTest, AnImportGoesInPiecesThatTheServerTakes) {
  FileService service;
  std::string file = kFile;
  constexpr std::int64_t kMaxRequest_bytes = 4096 + 10;  // 10 beside what frames a piece
  const auto mission = SendMissionFile(*service.stub, "copy", From(file), kMaxRequest_bytes);
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_EQ(*mission, "copy");
  EXPECT_EQ(service.imported, kFile);
  EXPECT_EQ(service.pieces, 5);  // of 44 bytes
  FileSum sum;
  sum.Add(kFile);
  EXPECT_EQ(service.end.total_bytes(), sum.bytes());
  EXPECT_EQ(service.end.sha256(), sum.TakeSha256());
}

TEST(MissionFileTest, ARefusalIsTheServers) {
  FileService service;
  service.refuses = true;
  std::string file = kFile;
  EXPECT_TRUE(
      absl::IsAlreadyExists(SendMissionFile(*service.stub, "copy", From(file), 1 << 18).status()));
}

TEST(MissionFileTest, ASourceThatFailsEndsTheImport) {
  FileService service;
  const auto broken = [](std::size_t) -> absl::StatusOr<std::string> {
    return absl::DataLossError("the disk is broken");
  };
  EXPECT_TRUE(absl::IsDataLoss(SendMissionFile(*service.stub, "copy", broken, 1 << 18).status()));
  const auto greedy = [](std::size_t max_bytes) { return std::string(max_bytes + 1, 'x'); };
  EXPECT_TRUE(
      absl::IsInvalidArgument(SendMissionFile(*service.stub, "copy", greedy, 1 << 18).status()));
}

}  // namespace mission_file_test
}  // namespace plumescout::client
