// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/option_help.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "google/protobuf/descriptor.h"
#include "google/protobuf/descriptor.pb.h"
#include "proto/convert/field.h"
#include "server/config/config_convert.h"
#include "server/config/option_path.h"

namespace plumescout::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

// A FileDescriptorSet of server_config.proto and what it imports, with comments.
constexpr unsigned char kDescriptors[] = {
#include "plumescout/config/v1/server_config.descriptors.inc"
};

// What stands above fields in the .proto files; programs do not have that otherwise.
class Comments {
 public:
  Comments() {
    google::protobuf::FileDescriptorSet files;
    files.ParseFromArray(kDescriptors, sizeof(kDescriptors));
    for (const auto& file : files.file()) pool_.BuildFile(file);
  }

  std::string Of(const FieldDescriptor& field) const {
    google::protobuf::SourceLocation location;
    const FieldDescriptor* known = pool_.FindFieldByName(field.full_name());
    if (known == nullptr || !known->GetSourceLocation(&location)) return "";
    return location.leading_comments;
  }

 private:
  google::protobuf::DescriptorPool pool_;
};

// Lines of at most 100 columns.
std::string Wrapped(const std::string& text) {
  constexpr char kIndent[] = "      ";
  constexpr std::size_t kColumns = 100;
  std::string wrapped;
  std::string line = kIndent;
  const std::vector<std::string> words =
      absl::StrSplit(text, absl::ByAnyChar(" \n"), absl::SkipEmpty());
  for (const std::string& word : words) {
    if (line.size() + 1 + word.size() > kColumns) {
      absl::StrAppend(&wrapped, line, "\n");
      line = kIndent;
    }
    absl::StrAppend(&line, line == kIndent ? "" : " ", word);
  }
  return absl::StrCat(wrapped, line, "\n");
}

std::string ValueText(const Message& message, const FieldDescriptor& field) {
  const Reflection& reflection = *message.GetReflection();
  if (!reflection.HasField(message, &field)) return "unset";
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(message, &field) ? "true" : "false";
    case FieldDescriptor::CPPTYPE_STRING:
      return reflection.GetString(message, &field);
    case FieldDescriptor::CPPTYPE_ENUM:
      return EnumText(*reflection.GetEnum(message, &field));
    case FieldDescriptor::CPPTYPE_INT32:
      return absl::StrCat(reflection.GetInt32(message, &field));
    case FieldDescriptor::CPPTYPE_INT64:
      return absl::StrCat(reflection.GetInt64(message, &field));
    default:
      return absl::StrCat(reflection.GetDouble(message, &field));
  }
}

std::string Choices(const FieldDescriptor& field) {
  if (field.enum_type() == nullptr) return "";
  return absl::StrCat(" One of ", EnumTexts(*field.enum_type()), ".");
}

void Append(const Comments& comments, const Message& message, const std::string& prefix,
            std::string& help) {
  for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *message.GetDescriptor()->field(i);
    const Reflection& reflection = *message.GetReflection();
    if (!IsOption(field)) continue;
    const std::string path = Join(prefix, field.name());
    const bool is_part = field.message_type() != nullptr;
    if (is_part && !field.is_repeated() && reflection.HasField(message, &field)) {
      Append(comments, reflection.GetMessage(message, &field), path, help);
      continue;
    }
    const std::string value = is_part ? "unset" : ValueText(message, field);
    absl::StrAppend(&help, "  ", path, " = ", value, "\n",
                    Wrapped(comments.Of(field) + Choices(field)));
  }
}

}  // namespace

std::string OptionHelp() {
  std::string help =
      "Options of the configuration; deploy/config/plumescout.yaml shows how lists are written:\n";
  Append(Comments(), ServerConfigToProto(ProgramDefaults()), "", help);
  return help;
}

}  // namespace plumescout::server
