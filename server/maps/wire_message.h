// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/message_lite.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/slice.h>

#include <cstddef>
#include <vector>

#include "absl/status/status.h"

namespace plumescout::server {

// The bytes of a message, to be shared: copies of a slice hold the same ones.
grpc::Slice Serialise(const google::protobuf::MessageLite& message);

// A message put together from serialised parts, which it shares with others instead of copying.
class WireMessage {
 public:
  // Adds all fields of a message of the same type.
  void Merge(const google::protobuf::MessageLite& message);
  // Adds a field whose type is a message. A repeated one gets one element more.
  void AddField(int field_number, const grpc::Slice& serialised);

  std::size_t bytes() const { return bytes_; }
  grpc::ByteBuffer Build() const { return {slices_.data(), slices_.size()}; }

 private:
  void Append(grpc::Slice slice);

  std::vector<grpc::Slice> slices_;
  std::size_t bytes_ = 0;
};

// The message that the bytes are; kInvalidArgument if they are none.
absl::Status Parse(const grpc::ByteBuffer& bytes, google::protobuf::MessageLite& message);

}  // namespace plumescout::server
