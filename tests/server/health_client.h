// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/server/service_clients.h"

namespace plumescout::server {

// As grpc.health.v1.HealthCheckResponse.ServingStatus.
enum class Health { kUnknown = 0, kServing = 1, kNotServing = 2, kEnded = -1 };

// A watch of the whole server's health. Its messages are read byte by byte, for the generated code
// of grpc.health.v1 is no part of gRPC's library.
class HealthWatch {
 public:
  explicit HealthWatch(const std::shared_ptr<grpc::Channel>& channel) : stub_(channel) {
    SetPatience(context_);
    stream_ = stub_.PrepareCall(&context_, "/grpc.health.v1.Health/Watch", &queue_);
    stream_->StartCall(nullptr);
    EXPECT_TRUE(Done());
    const grpc::Slice whole_server;  // HealthCheckRequest{}
    stream_->WriteLast(grpc::ByteBuffer(&whole_server, 1), grpc::WriteOptions(), nullptr);
    EXPECT_TRUE(Done());
  }
  ~HealthWatch() {
    context_.TryCancel();
    grpc::Status status;
    stream_->Finish(&status, nullptr);
    Done();
    queue_.Shutdown();
  }

  Health Read() {
    constexpr unsigned char kStatusKey = 1 << 3;  // field 1, a varint
    grpc::ByteBuffer message;
    stream_->Read(&message, nullptr);
    if (!Done()) return Health::kEnded;
    grpc::Slice bytes;
    EXPECT_TRUE(message.DumpToSingleSlice(&bytes).ok());
    if (bytes.size() == 0) return Health::kUnknown;
    EXPECT_EQ(bytes.size(), 2u);
    EXPECT_EQ(bytes.begin()[0], kStatusKey);
    return static_cast<Health>(bytes.begin()[1]);
  }
  void Cancel() { context_.TryCancel(); }

 private:
  // Waits for the operation just started.
  bool Done() {
    void* tag = nullptr;
    bool ok = false;
    return queue_.Next(&tag, &ok) && ok;
  }

  grpc::GenericStub stub_;
  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> stream_;
};

}  // namespace plumescout::server
