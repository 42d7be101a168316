// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"

namespace plumescout::server {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// One way to spoil a good request, and what the server must make of it.
struct BadInput {
  std::string field;  // that the row is about, a path without indices: "batch.observations.pose"
  std::string what;
  std::function<void(Message&)> spoil;
  absl::StatusCode code = absl::StatusCode::kInvalidArgument;
  // kInvalidArgument: the field that the refusal blames. Other codes: the reason it gives.
  std::string blamed;
};

// Sets the field at `path` to a value in protobuf's text format. Of repeated messages it is the
// first that is set; a repeated scalar gets one element more.
inline void SetField(Message& message, absl::string_view path, const std::string& value) {
  Message* part = &message;
  const std::vector<std::string> names = absl::StrSplit(path, '.');
  for (const std::string& name : names) {
    const FieldDescriptor* field = part->GetDescriptor()->FindFieldByName(name);
    ASSERT_NE(field, nullptr) << path;
    if (&name == &names.back()) {
      ASSERT_TRUE(google::protobuf::TextFormat::ParseFieldValueFromString(value, field, part))
          << path << " = " << value;
    } else if (field->is_repeated()) {
      const auto* reflection = part->GetReflection();
      part = reflection->FieldSize(*part, field) == 0
                 ? reflection->AddMessage(part, field)
                 : reflection->MutableRepeatedMessage(part, field, 0);
    } else {
      part = part->GetReflection()->MutableMessage(part, field);
    }
  }
}

// The rows of one kind of request.
class BadInputs {
 public:
  // Each value is refused and the field blamed.
  BadInputs& Values(const std::string& field, std::initializer_list<const char*> values) {
    return ValuesBlaming(field, field, values);
  }
  BadInputs& ValuesBlaming(const std::string& blamed, const std::string& field,
                           std::initializer_list<const char*> values) {
    for (const char* value : values) {
      Row({field, value, Setter(field, value), absl::StatusCode::kInvalidArgument, blamed});
    }
    return *this;
  }
  // The value is refused with another code, for this reason.
  BadInputs& Value(const std::string& field, const char* value, absl::StatusCode code,
                   const std::string& reason) {
    return Row({field, value, Setter(field, value), code, reason});
  }
  BadInputs& Row(BadInput row) {
    rows_.push_back(std::move(row));
    return *this;
  }
  BadInputs& Rows(const BadInputs& others) {
    rows_.insert(rows_.end(), others.rows_.begin(), others.rows_.end());
    return *this;
  }
  const std::vector<BadInput>& rows() const { return rows_; }

 private:
  static std::function<void(Message&)> Setter(const std::string& field, const std::string& value) {
    return [=](Message& message) { SetField(message, field, value); };
  }

  std::vector<BadInput> rows_;
};

// Paths of all fields and oneofs below `type`.
inline void CollectPaths(const Descriptor& type, const std::string& parent,
                         std::set<std::string>& paths) {
  for (int i = 0; i < type.real_oneof_decl_count(); ++i) {
    paths.insert(absl::StrCat(parent, type.oneof_decl(i)->name()));
  }
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    const std::string path = absl::StrCat(parent, field.name());
    paths.insert(path);
    if (field.message_type() != nullptr) {
      CollectPaths(*field.message_type(), absl::StrCat(path, "."), paths);
    }
  }
}

}  // namespace plumescout::server
