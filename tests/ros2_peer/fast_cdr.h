// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Messages of formats/ros as bytes and back by Fast CDR: alignment and byte order are not ours.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace plumescout::ros2_peer {

class FastCdrWriter {
 public:
  FastCdrWriter() { cdr_.serialize_encapsulation(); }

  template <typename... Fields>
  void operator()(const Fields&... fields) {
    (Write(fields), ...);
  }
  std::string bytes() { return {buffer_.getBuffer(), cdr_.getSerializedDataLength()}; }

 private:
  template <typename T>
  void Write(const T& field) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      cdr_ << field;
    } else {
      T::Visit(*this, field);
    }
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

  eprosima::fastcdr::FastBuffer buffer_;
  eprosima::fastcdr::Cdr cdr_{buffer_, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                              eprosima::fastcdr::Cdr::DDS_CDR};
};

// Throws eprosima::fastcdr::exception::Exception at what is no such message.
class FastCdrReader {
 public:
  explicit FastCdrReader(std::string& bytes) : buffer_(bytes.data(), bytes.size()) {
    cdr_.read_encapsulation();
  }

  template <typename... Fields>
  void operator()(Fields&... fields) {
    (Read(fields), ...);
  }

 private:
  template <typename T>
  void Read(T& field) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      cdr_ >> field;
    } else {
      T::Visit(*this, field);
    }
  }
  template <typename T>
  void Read(std::vector<T>& fields) {
    std::uint32_t count = 0;
    Read(count);
    fields.clear();
    for (std::uint32_t i = 0; i < count; ++i) Read(fields.emplace_back());
  }

  eprosima::fastcdr::FastBuffer buffer_;
  eprosima::fastcdr::Cdr cdr_{buffer_, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                              eprosima::fastcdr::Cdr::DDS_CDR};
};

template <typename Message>
std::string Encode(const Message& message) {
  FastCdrWriter writer;
  Message::Visit(writer, message);
  return writer.bytes();
}

template <typename Message>
Message Decode(std::string bytes) {
  FastCdrReader reader(bytes);
  Message message;
  Message::Visit(reader, message);
  return message;
}

}  // namespace plumescout::ros2_peer
