// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/draw/typed_channels.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

constexpr char kProtobuf[] = "protobuf";

using google::protobuf::Descriptor;
using google::protobuf::FileDescriptor;

// Names of messages and enumerations that stand in no other.
using Parts = std::set<std::string>;

const Descriptor& Outermost(const Descriptor& type) {
  return type.containing_type() == nullptr ? type : Outermost(*type.containing_type());
}

void AddParts(const Descriptor& type, Parts& parts);

void AddPartsOfFields(const Descriptor& type, Parts& parts) {
  for (int i = 0; i < type.field_count(); ++i) {
    const google::protobuf::FieldDescriptor& field = *type.field(i);
    if (field.message_type() != nullptr) AddParts(*field.message_type(), parts);
    if (field.enum_type() == nullptr) continue;
    const Descriptor* around = field.enum_type()->containing_type();
    if (around == nullptr) parts.insert(field.enum_type()->full_name());
    if (around != nullptr) AddParts(*around, parts);
  }
  for (int i = 0; i < type.nested_type_count(); ++i) AddPartsOfFields(*type.nested_type(i), parts);
}

// What the type is made of, itself among it.
void AddParts(const Descriptor& type, Parts& parts) {
  const Descriptor& whole = Outermost(type);
  if (parts.insert(whole.full_name()).second) AddPartsOfFields(whole, parts);
}

template <typename Declared>
void KeepParts(const std::string& package, const Parts& parts,
               google::protobuf::RepeatedPtrField<Declared>& declared) {
  const auto is_none = [&](const Declared& one) {
    return parts.count(absl::StrCat(package, ".", one.name())) == 0;
  };
  declared.erase(std::remove_if(declared.begin(), declared.end(), is_none), declared.end());
}

// Of the file and what it imports the parts, each file once, imports first. False: it has none.
bool AddFile(const FileDescriptor& file, const Parts& parts, std::map<std::string, bool>& added,
             google::protobuf::FileDescriptorSet& files) {
  const auto [place, is_new] = added.try_emplace(file.name(), false);
  if (!is_new) return place->second;
  google::protobuf::FileDescriptorProto kept;
  file.CopyTo(&kept);
  kept.clear_service();
  kept.clear_dependency();
  for (int i = 0; i < file.dependency_count(); ++i) {
    const FileDescriptor& imported = *file.dependency(i);
    if (AddFile(imported, parts, added, files)) kept.add_dependency(imported.name());
  }
  KeepParts(file.package(), parts, *kept.mutable_message_type());
  KeepParts(file.package(), parts, *kept.mutable_enum_type());
  place->second = kept.message_type_size() + kept.enum_type_size() > 0;
  if (place->second) *files.add_file() = std::move(kept);
  return place->second;
}

}  // namespace

std::uint16_t TypedChannels::SchemaOf(const google::protobuf::Descriptor& type) {
  const auto [schema, is_new] = schemas_.try_emplace(type.full_name(), 0);
  if (is_new) {
    google::protobuf::FileDescriptorSet files;
    Parts parts;
    AddParts(type, parts);
    std::map<std::string, bool> added;
    AddFile(*type.file(), parts, added, files);
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
