// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/wire_message.h"

#include <google/protobuf/io/coded_stream.h>

#include <cstdint>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"

namespace plumescout::server {
namespace {

using google::protobuf::io::CodedOutputStream;

constexpr std::size_t kMaxPrefix_bytes = 10;  // of two numbers of 32 bits
// In a field's tag, beside its number: its length follows, then its bytes.
constexpr int kTypeBits = 3;
constexpr int kLengthDelimited = 2;

}  // namespace

grpc::Slice Serialise(const google::protobuf::MessageLite& message) {
  return grpc::Slice(message.SerializeAsString());
}

void WireMessage::Merge(const google::protobuf::MessageLite& message) {
  Append(Serialise(message));
}

void WireMessage::AddField(int field_number, const grpc::Slice& serialised) {
  std::uint8_t prefix[kMaxPrefix_bytes];
  const int tag = (field_number << kTypeBits) | kLengthDelimited;
  std::uint8_t* end =
      CodedOutputStream::WriteVarint32ToArray(static_cast<std::uint32_t>(tag), prefix);
  end = CodedOutputStream::WriteVarint32ToArray(static_cast<std::uint32_t>(serialised.size()), end);
  Append(grpc::Slice(prefix, static_cast<std::size_t>(end - prefix)));
  Append(serialised);
}

void WireMessage::Append(grpc::Slice slice) {
  bytes_ += slice.size();
  slices_.push_back(std::move(slice));
}

absl::Status Parse(const grpc::ByteBuffer& bytes, google::protobuf::MessageLite& message) {
  std::vector<grpc::Slice> slices;
  std::string text;
  if (bytes.Dump(&slices).ok()) {
    for (const grpc::Slice& slice : slices) {
      text.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
    }
    if (message.ParseFromString(text)) return absl::OkStatus();
  }
  return absl::InvalidArgumentError(absl::StrCat("the bytes are no ", message.GetTypeName()));
}

}  // namespace plumescout::server
