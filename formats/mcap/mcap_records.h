// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>

#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "formats/little_endian.h"

namespace plumescout {

// The records of an MCAP file (https://mcap.dev/spec), fields in their order there. Numbers are
// little-endian, texts have a uint32 of their length before them, and so have maps of theirs in
// bytes.

inline constexpr absl::string_view kMcapMagic = "\x89MCAP0\r\n";

enum class McapOp : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

struct McapSchema {
  std::uint16_t id = 0;  // 0 is none
  std::string name = {};
  std::string encoding = {};
  std::string data = {};

  friend bool operator==(const McapSchema&, const McapSchema&) = default;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  // 0: none
  std::string topic = {};
  std::string message_encoding = {};

  friend bool operator==(const McapChannel&, const McapChannel&) = default;
};

struct McapMessage {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::string data = {};

  friend bool operator==(const McapMessage&, const McapMessage&) = default;
};

struct McapChunk {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t uncompressed_bytes = 0;
  std::uint32_t uncompressed_crc = 0;  // 0: not known
  absl::string_view compression;
  absl::string_view records;  // as they are packed
};

struct McapChunkIndex {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t chunk_at = 0;
  std::uint64_t chunk_bytes = 0;                           // of the whole record
  std::map<std::uint16_t, std::uint64_t> indexes_at = {};  // of message indexes, by channel
  std::uint64_t indexes_bytes = 0;
  std::string compression = {};
  std::uint64_t compressed_bytes = 0;
  std::uint64_t uncompressed_bytes = 0;
};

struct McapStatistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::map<std::uint16_t, std::uint64_t> messages_of = {};  // by channel
};

struct McapFooter {
  std::uint64_t summary_at = 0;          // 0: there is none
  std::uint64_t summary_offsets_at = 0;  // 0: there are none
  std::uint32_t summary_crc = 0;         // 0: not known
};

// The CRC-32 of zlib; to go on from a first piece pass its result.
std::uint32_t McapCrc(absl::string_view bytes, std::uint32_t crc = 0);

// Appends the fields of a record.
class McapFields {
 public:
  template <typename T>
  McapFields& Number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }
  McapFields& Text(absl::string_view text);
  McapFields& Bytes(absl::string_view bytes) {
    absl::StrAppend(&bytes_, bytes);
    return *this;
  }
  McapFields& Counts(const std::map<std::uint16_t, std::uint64_t>& counts);

  const std::string& bytes() const { return bytes_; }
  // The whole record, with its code and length.
  std::string Record(McapOp op) const;

 private:
  std::string bytes_;
};

// Whole records.
std::string EncodeMcap(const McapSchema& schema);
std::string EncodeMcap(const McapChannel& channel);
std::string EncodeMcap(const McapMessage& message);
std::string EncodeMcap(const McapChunk& chunk);
std::string EncodeMcap(const McapChunkIndex& index);
std::string EncodeMcap(const McapStatistics& statistics);

// The fields of a record, without its code and length. False, with `record` anywhere, if they end
// too early; what follows them is of a later version of the format and left out. Views are of
// `fields`.
bool DecodeMcap(absl::string_view fields, McapSchema& schema);
bool DecodeMcap(absl::string_view fields, McapChannel& channel);
bool DecodeMcap(absl::string_view fields, McapMessage& message);
bool DecodeMcap(absl::string_view fields, McapChunk& chunk);
bool DecodeMcap(absl::string_view fields, McapChunkIndex& index);
bool DecodeMcap(absl::string_view fields, McapStatistics& statistics);
bool DecodeMcap(absl::string_view fields, McapFooter& footer);

// Bytes of a record before its fields.
inline constexpr std::size_t kMcapHeadBytes = 9;

// The first record of `rest`.
struct McapRecord {
  McapOp op = {};
  absl::string_view fields;
};
// Takes a record off the front of `rest`; false, with `rest` as it was, if it holds no whole one.
bool TakeMcapRecord(absl::string_view& rest, McapRecord& record);

}  // namespace plumescout
