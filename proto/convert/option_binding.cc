// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/option_binding.h"

#include <cassert>
#include "google/protobuf/descriptor.h"

namespace plumescout {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

const FieldDescriptor* Find(const Message& message, absl::string_view name) {
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(std::string(name));
  assert(field != nullptr && "options and message differ");
  return field;
}

// The field if it is set.
const FieldDescriptor* FindSet(const Message& message, absl::string_view name) {
  const FieldDescriptor* field = Find(message, name);
  return message.GetReflection()->HasField(message, field) ? field : nullptr;
}

}  // namespace

void OptionWriter::operator()(absl::string_view name, bool value) {
  message_.GetReflection()->SetBool(&message_, Find(message_, name), value);
}
void OptionWriter::operator()(absl::string_view name, int value) {
  message_.GetReflection()->SetInt32(&message_, Find(message_, name), value);
}
void OptionWriter::operator()(absl::string_view name, std::int64_t value) {
  message_.GetReflection()->SetInt64(&message_, Find(message_, name), value);
}
void OptionWriter::operator()(absl::string_view name, std::uint64_t value) {
  (*this)(name, static_cast<std::int64_t>(value));
}
void OptionWriter::operator()(absl::string_view name, double value) {
  message_.GetReflection()->SetDouble(&message_, Find(message_, name), value);
}
void OptionWriter::operator()(absl::string_view name, const std::string& value) {
  message_.GetReflection()->SetString(&message_, Find(message_, name), value);
}
void OptionWriter::operator()(absl::string_view name, const std::optional<double>& value) {
  if (value) (*this)(name, *value);
}
void OptionWriter::SetEnum(absl::string_view name, int value) {
  message_.GetReflection()->SetEnumValue(&message_, Find(message_, name), value);
}

void OptionReader::operator()(absl::string_view name, bool& value) const {
  const FieldDescriptor* field = FindSet(message_, name);
  if (field != nullptr) value = message_.GetReflection()->GetBool(message_, field);
}
void OptionReader::operator()(absl::string_view name, int& value) const {
  const FieldDescriptor* field = FindSet(message_, name);
  if (field != nullptr) value = message_.GetReflection()->GetInt32(message_, field);
}
void OptionReader::operator()(absl::string_view name, std::int64_t& value) const {
  const FieldDescriptor* field = FindSet(message_, name);
  if (field != nullptr) value = message_.GetReflection()->GetInt64(message_, field);
}
void OptionReader::operator()(absl::string_view name, std::uint64_t& value) const {
  const FieldDescriptor* field = FindSet(message_, name);
  if (field == nullptr) return;
  value = static_cast<std::uint64_t>(message_.GetReflection()->GetInt64(message_, field));
}
void OptionReader::operator()(absl::string_view name, double& value) const {
  const FieldDescriptor* field = FindSet(message_, name);
  if (field != nullptr) value = message_.GetReflection()->GetDouble(message_, field);
}
void OptionReader::operator()(absl::string_view name, std::string& value) const {
  const FieldDescriptor* field = FindSet(message_, name);
  if (field != nullptr) value = message_.GetReflection()->GetString(message_, field);
}
void OptionReader::operator()(absl::string_view name, std::optional<double>& value) const {
  const FieldDescriptor* field = FindSet(message_, name);
  if (field != nullptr) value = message_.GetReflection()->GetDouble(message_, field);
}
int OptionReader::EnumNumber(absl::string_view name) const {
  return message_.GetReflection()->GetEnumValue(message_, Find(message_, name));
}

}  // namespace plumescout
