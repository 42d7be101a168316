// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace plumescout::ros {

// Writes messages as CdrReader reads them: little-endian XCDR1, which is what ROS 2 exchanges.
class CdrWriter {
 public:
  template <typename... Fields>
  void operator()(const Fields&... fields) {
    (Write(fields), ...);
  }

  std::string Take() && { return std::move(bytes_); }

 private:
  template <typename T>
  void Write(const T& field) {
    if constexpr (std::is_arithmetic_v<T>) {
      WriteNumber(&field, sizeof(T));
    } else {
      T::Visit(*this, field);
    }
  }
  void Write(const std::string& text) {
    Write(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text.c_str(), text.size() + 1);
  }
  template <typename T, std::size_t kSize>
  void Write(const std::array<T, kSize>& fields) {
    for (const T& field : fields) Write(field);
  }
  template <typename T>
  void Write(const std::vector<T>& fields) {
    Write(static_cast<std::uint32_t>(fields.size()));
    for (const T& field : fields) Write(field);
  }
  void WriteNumber(const void* number, std::size_t size) {
    // The encapsulation's four bytes do not count.
    const std::size_t length = bytes_.size() - kEncapsulation_bytes;
    bytes_.append((size - length % size) % size, '\0');
    bytes_.append(static_cast<const char*>(number), size);
  }

  static constexpr std::size_t kEncapsulation_bytes = 4;
  std::string bytes_ = std::string("\0\1\0\0", kEncapsulation_bytes);
};

// With its encapsulation.
template <typename Message>
std::string EncodeCdr(const Message& message) {
  CdrWriter writer;
  Message::Visit(writer, message);
  return std::move(writer).Take();
}

}  // namespace plumescout::ros
