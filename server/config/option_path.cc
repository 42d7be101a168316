// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/option_path.h"

#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/strip.h"
#include "core/types/status_macros.h"

namespace plumescout::server {
namespace {

using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

absl::Status Refuse(const std::string& text, absl::string_view wanted) {
  return absl::InvalidArgumentError(absl::StrCat("= ", text, " must be ", wanted));
}

// The value that is written so; the unspecified one is not for people.
const EnumValueDescriptor* FindEnumValue(const FieldDescriptor& field, const std::string& text) {
  for (int i = 1; i < field.enum_type()->value_count(); ++i) {
    const EnumValueDescriptor* value = field.enum_type()->value(i);
    if (EnumText(*value) == text) return value;
  }
  return nullptr;
}

absl::Status SetEnum(Message& message, const FieldDescriptor& field, const std::string& text) {
  const EnumValueDescriptor* value = FindEnumValue(field, text);
  if (value == nullptr) return Refuse(text, absl::StrCat("one of ", EnumTexts(*field.enum_type())));
  message.GetReflection()->SetEnum(&message, &field, value);
  return absl::OkStatus();
}

absl::Status SetNumber(Message& message, const FieldDescriptor& field, const std::string& text) {
  const Reflection& reflection = *message.GetReflection();
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
    double value = 0.0;
    if (!absl::SimpleAtod(text, &value)) return Refuse(text, "a number");
    reflection.SetDouble(&message, &field, value);
    return absl::OkStatus();
  }
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_INT32) {
    std::int32_t value = 0;
    if (!absl::SimpleAtoi(text, &value)) return Refuse(text, "a whole number of 32 bits");
    reflection.SetInt32(&message, &field, value);
    return absl::OkStatus();
  }
  std::int64_t value = 0;
  if (!absl::SimpleAtoi(text, &value)) return Refuse(text, "a whole number of 64 bits");
  reflection.SetInt64(&message, &field, value);
  return absl::OkStatus();
}

absl::Status SetScalar(Message& message, const FieldDescriptor& field, const std::string& text) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      if (text != "true" && text != "false") return Refuse(text, "true or false");
      message.GetReflection()->SetBool(&message, &field, text == "true");
      return absl::OkStatus();
    case FieldDescriptor::CPPTYPE_STRING:
      message.GetReflection()->SetString(&message, &field, text);
      return absl::OkStatus();
    case FieldDescriptor::CPPTYPE_ENUM:
      return SetEnum(message, field, text);
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_INT64:
      return SetNumber(message, field, text);
    default:
      return absl::NotFoundError("not an option");
  }
}

// "keep_out[2]" and "keep_out" apart.
struct Step {
  std::string name;
  std::optional<int> index;
};

absl::StatusOr<Step> ReadStep(absl::string_view text) {
  const std::size_t bracket = text.find('[');
  if (bracket == absl::string_view::npos) return Step{std::string(text), std::nullopt};
  absl::string_view number = text.substr(bracket + 1);
  int index = 0;
  if (!absl::ConsumeSuffix(&number, "]") || !absl::SimpleAtoi(number, &index) || index < 0) {
    return absl::NotFoundError("not an option");
  }
  return Step{std::string(text.substr(0, bracket)), index};
}

// The message in the field, or its element, which may be the one after the last.
Message* FindPart(Message& message, const FieldDescriptor& field, std::optional<int> index) {
  const Reflection& reflection = *message.GetReflection();
  if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) return nullptr;
  if (field.is_repeated() != index.has_value()) return nullptr;
  if (!index) return reflection.MutableMessage(&message, &field);
  const int size = reflection.FieldSize(message, &field);
  if (*index > size) return nullptr;
  return *index == size ? reflection.AddMessage(&message, &field)
                        : reflection.MutableRepeatedMessage(&message, &field, *index);
}

}  // namespace

bool IsOption(const FieldDescriptor& field) {
  if (field.type() == FieldDescriptor::TYPE_BYTES) return false;
  return field.message_type() == nullptr || field.message_type()->real_oneof_decl_count() == 0;
}

std::string EnumText(const EnumValueDescriptor& value) {
  // Its names begin with the type's, as that of the value 0 does: GOAL_POLICY_UNSPECIFIED.
  absl::string_view prefix = value.type()->FindValueByNumber(0)->name();
  absl::string_view text = value.name();
  if (!absl::ConsumeSuffix(&prefix, "UNSPECIFIED") || !absl::ConsumePrefix(&text, prefix) ||
      value.number() == 0) {
    return "";
  }
  return absl::AsciiStrToLower(text);
}

std::string EnumTexts(const google::protobuf::EnumDescriptor& type) {
  std::vector<std::string> texts;
  for (int i = 1; i < type.value_count(); ++i) texts.push_back(EnumText(*type.value(i)));
  return absl::StrJoin(texts, ", ");
}

absl::Status SetOption(Message& message, absl::string_view path, const std::string& text) {
  const std::size_t dot = path.find('.');
  PLUMESCOUT_ASSIGN_OR_RETURN(const Step step, ReadStep(path.substr(0, dot)));
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(step.name);
  if (field == nullptr || !IsOption(*field)) return absl::NotFoundError("not an option");
  if (dot == absl::string_view::npos) {
    const bool is_scalar = !field->is_repeated() && !step.index;
    return is_scalar ? SetScalar(message, *field, text) : absl::NotFoundError("not an option");
  }
  Message* part = FindPart(message, *field, step.index);
  if (part == nullptr) return absl::NotFoundError("not an option");
  return SetOption(*part, path.substr(dot + 1), text);
}

}  // namespace plumescout::server
