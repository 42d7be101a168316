// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "google/protobuf/message.h"
#include "proto/convert/enums.h"
#include "proto/convert/field.h"

namespace plumescout {

// Structs of options have members of the same name and meaning as the fields of their messages. A
// function names each pair once,
//
//   void Visit(OneOf<GasOptions> auto& options, auto& field) {
//     field("lattice_factor", options.lattice_factor); ...
//
// and serves both ways: with a OptionWriter as `field`, or with a OptionReader. A name that the
// message lacks is our bug.
template <typename Type, typename Struct>
concept OneOf = std::same_as<std::remove_const_t<Type>, Struct>;

template <typename Type>
concept Enumeration = std::is_enum_v<Type>;

// Sets fields of `message`, which must outlive it. Optional members without a value set none.
class OptionWriter {
 public:
  explicit OptionWriter(google::protobuf::Message& message) : message_(message) {}

  void operator()(absl::string_view name, bool value);
  void operator()(absl::string_view name, int value);
  void operator()(absl::string_view name, std::int64_t value);
  void operator()(absl::string_view name, std::uint64_t value);  // the same bits, as an int64
  void operator()(absl::string_view name, double value);
  void operator()(absl::string_view name, const std::string& value);
  void operator()(absl::string_view name, const std::optional<double>& value);
  void operator()(absl::string_view name, Enumeration auto value) {
    SetEnum(name, static_cast<int>(ToProto(value)));
  }

 private:
  void SetEnum(absl::string_view name, int value);

  google::protobuf::Message& message_;
};

// Takes the fields that are set in `message`, which must outlive it, and leaves other members as
// they are; an enum that is unspecified counts as unset.
class OptionReader {
 public:
  // `path`: of the message, from the request; for refusals.
  OptionReader(const google::protobuf::Message& message, absl::string_view path)
      : message_(message), path_(path) {}

  void operator()(absl::string_view name, bool& value) const;
  void operator()(absl::string_view name, int& value) const;
  void operator()(absl::string_view name, std::int64_t& value) const;
  void operator()(absl::string_view name, std::uint64_t& value) const;
  void operator()(absl::string_view name, double& value) const;
  void operator()(absl::string_view name, std::string& value) const;
  void operator()(absl::string_view name, std::optional<double>& value) const;
  template <Enumeration Enum>
  void operator()(absl::string_view name, Enum& value) {
    const int number = EnumNumber(name);
    if (number == 0) return;
    using Wire = decltype(ToProto(value));
    const absl::StatusOr<Enum> read = FromProto(static_cast<Wire>(number), Join(path_, name));
    if (read.ok()) value = *read;
    status_.Update(read.status());
  }

  // The first refusal.
  const absl::Status& status() const { return status_; }

 private:
  int EnumNumber(absl::string_view name) const;

  const google::protobuf::Message& message_;
  std::string path_;
  absl::Status status_;
};

}  // namespace plumescout
