// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout::ros {

// Reads what DDS and rosbag2 carry: four bytes that name the encoding, then fields in plain CDR
// (XCDR1), each aligned to its own size, of either byte order. After the first thing that is wrong
// nothing more is read; what was read so far is of no use then.
class CdrReader {
 public:
  explicit CdrReader(absl::string_view bytes);

  template <typename... Fields>
  void operator()(Fields&... fields) {
    (Read(fields), ...);
  }

  // kInvalidArgument: another encoding, an end that comes too early, or bytes beyond the message.
  absl::Status Finish();

 private:
  template <typename T>
  void Read(T& field) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      ReadNumber(&byte, sizeof(byte));
      field = byte != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      ReadNumber(&field, sizeof(T));
    } else {
      T::Visit(*this, field);
    }
  }
  void Read(std::string& text);
  template <typename T, std::size_t kSize>
  void Read(std::array<T, kSize>& fields) {
    for (T& field : fields) Read(field);
  }
  template <typename T>
  void Read(std::vector<T>& fields) {
    fields.clear();
    std::uint32_t count = 0;
    Read(count);
    // No element takes less than a byte.
    if (count > left() / (std::is_arithmetic_v<T> ? sizeof(T) : 1)) {
      return Fail("a sequence is longer than the message");
    }
    if constexpr (std::is_arithmetic_v<T>) fields.reserve(count);
    for (std::uint32_t i = 0; i < count && status_.ok(); ++i) Read(fields.emplace_back());
  }
  void ReadNumber(void* number, std::size_t size);
  std::size_t left() const { return bytes_.size() - at_; }
  void Fail(absl::string_view why);

  absl::string_view bytes_;  // after the encapsulation
  std::size_t at_ = 0;
  bool swapped_ = false;
  absl::Status status_;
};

template <typename Message>
absl::StatusOr<Message> DecodeCdr(absl::string_view bytes) {
  CdrReader reader(bytes);
  Message message;
  Message::Visit(reader, message);
  if (absl::Status status = reader.Finish(); !status.ok()) {
    return absl::Status(status.code(),
                        std::string(Message::kType) + ": " + std::string(status.message()));
  }
  return message;
}

}  // namespace plumescout::ros
