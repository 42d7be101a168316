// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "google/protobuf/descriptor.h"
#include "google/protobuf/message.h"
#include "tests/server/service_clients.h"

namespace plumescout::server {

// All that a caller hears in answer to one request: how the call ended and its first response.
struct Answer {
  grpc::StatusCode code = grpc::StatusCode::OK;
  std::string message;
  std::string details;  // a google.rpc.Status
  bool responded = false;
  std::string response;

  friend bool operator==(const Answer&, const Answer&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Answer& answer) {
    return out << "code " << answer.code << " \"" << answer.message << "\" details \""
               << absl::CHexEscape(answer.details) << "\" response \""
               << (answer.responded ? absl::CHexEscape(answer.response) : "none") << "\"";
  }
};

// Calls any method, of any kind, with one request. Of a stream of responses the first is read; then
// the call is cancelled.
class AnyCall {
 public:
  // `token`: empty for none.
  AnyCall(const std::shared_ptr<grpc::Channel>& channel,
          const google::protobuf::MethodDescriptor& method, const std::string& token)
      : method_(method), stub_(channel) {
    SetPatience(context_);
    context_.AddMetadata("x-request-id", "fixed");  // it may be in details
    if (!token.empty()) context_.AddMetadata("authorization", absl::StrCat("Bearer ", token));
  }

  Answer Make(const google::protobuf::Message& request) {
    const std::string path = absl::StrCat("/", method_.service()->full_name(), "/", method_.name());
    const auto stream = stub_.PrepareCall(&context_, path, &queue_);
    stream->StartCall(nullptr);
    Done();
    const grpc::Slice bytes(request.SerializeAsString());
    stream->WriteLast(grpc::ByteBuffer(&bytes, 1), grpc::WriteOptions(), nullptr);
    Done();  // fails if the call has ended: its status says why
    Answer answer;
    grpc::ByteBuffer response;
    stream->Read(&response, nullptr);
    answer.responded = Done();
    if (answer.responded) {
      grpc::Slice slice;
      EXPECT_TRUE(response.DumpToSingleSlice(&slice).ok());
      answer.response.assign(reinterpret_cast<const char*>(slice.begin()), slice.size());
      if (method_.server_streaming()) context_.TryCancel();
    }
    grpc::Status status;
    stream->Finish(&status, nullptr);
    Done();
    queue_.Shutdown();
    answer.code = status.error_code();
    answer.message = status.error_message();
    answer.details = status.error_details();
    return answer;
  }

 private:
  // Waits for the operation just started.
  bool Done() {
    void* tag = nullptr;
    bool ok = false;
    return queue_.Next(&tag, &ok) && ok;
  }

  const google::protobuf::MethodDescriptor& method_;
  grpc::GenericStub stub_;
  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
};

}  // namespace plumescout::server
