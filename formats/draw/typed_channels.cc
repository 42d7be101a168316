// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/draw/typed_channels.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/message.h>

#include <set>

namespace plumescout {
namespace {

constexpr char kProtobuf[] = "protobuf";

// The file and what it imports, each once, imports first.
void AddFile(const google::protobuf::FileDescriptor& file, std::set<std::string>& added,
             google::protobuf::FileDescriptorSet& files) {
  if (!added.insert(file.name()).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) AddFile(*file.dependency(i), added, files);
  file.CopyTo(files.add_file());
}

}  // namespace

std::uint16_t TypedChannels::SchemaOf(const google::protobuf::Descriptor& type) {
  const auto [schema, is_new] = schemas_.try_emplace(type.full_name(), 0);
  if (is_new) {
    google::protobuf::FileDescriptorSet files;
    std::set<std::string> added;
    AddFile(*type.file(), added, files);
    schema->second = encoder_.AddSchema(type.full_name(), kProtobuf, files.SerializeAsString());
  }
  return schema->second;
}

absl::Status TypedChannels::Add(const std::string& topic, const google::protobuf::Message& message,
                                McapTimes times) {
  const auto [channel, is_new] = channels_.try_emplace(topic);
  if (is_new) {
    const std::uint16_t schema = SchemaOf(*message.GetDescriptor());
    channel->second.id = encoder_.AddChannel(topic, kProtobuf, schema);
  }
  return encoder_.Add({channel->second.id, ++channel->second.messages,
                       static_cast<std::uint64_t>(times.log_ns),
                       static_cast<std::uint64_t>(times.publish_ns), message.SerializeAsString()});
}

}  // namespace plumescout
