// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/mcap/mcap_records.h"

#include <zlib.h>

namespace plumescout {
namespace {

// Takes fields off the front, in their order; fails for good once there is too little.
class Fields {
 public:
  explicit Fields(absl::string_view bytes) : rest_(bytes) {}

  template <typename T>
  Fields& Number(T& value) {
    const absl::string_view bytes = Take(sizeof(T));
    if (ok_) value = LoadLittleEndian<T>(bytes.data());
    return *this;
  }
  template <typename Length = std::uint32_t>
  Fields& View(absl::string_view& view) {
    Length length = 0;
    Number(length);
    view = Take(length);
    return *this;
  }
  Fields& Text(std::string& text) {
    absl::string_view view;
    View(view);
    text.assign(view.data(), view.size());
    return *this;
  }
  Fields& Counts(std::map<std::uint16_t, std::uint64_t>& counts) {
    absl::string_view view;
    View(view);
    Fields entries(view);
    while (ok_ && !entries.rest_.empty()) {
      std::uint16_t key = 0;
      std::uint64_t value = 0;
      ok_ = entries.Number(key).Number(value).ok();
      counts[key] = value;
    }
    return *this;
  }
  Fields& Rest(std::string& bytes) {
    if (ok_) bytes.assign(rest_.data(), rest_.size());
    return *this;
  }
  bool ok() const { return ok_; }

 private:
  absl::string_view Take(std::uint64_t count) {
    ok_ = ok_ && count <= rest_.size();
    if (!ok_) return {};
    const absl::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  absl::string_view rest_;
  bool ok_ = true;
};

}  // namespace

std::uint32_t McapCrc(absl::string_view bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

McapFields& McapFields::Text(absl::string_view text) {
  return Number(static_cast<std::uint32_t>(text.size())).Bytes(text);
}

McapFields& McapFields::Counts(const std::map<std::uint16_t, std::uint64_t>& counts) {
  constexpr std::size_t kEntryBytes = sizeof(std::uint16_t) + sizeof(std::uint64_t);
  Number(static_cast<std::uint32_t>(counts.size() * kEntryBytes));
  for (const auto& [key, count] : counts) Number(key).Number(count);
  return *this;
}

std::string McapFields::Record(McapOp op) const {
  return absl::StrCat(McapFields()
                          .Number(static_cast<std::uint8_t>(op))
                          .Number(std::uint64_t{bytes_.size()})
                          .bytes(),
                      bytes_);
}

std::string EncodeMcap(const McapSchema& schema) {
  return McapFields()
      .Number(schema.id)
      .Text(schema.name)
      .Text(schema.encoding)
      .Text(schema.data)
      .Record(McapOp::kSchema);
}

std::string EncodeMcap(const McapChannel& channel) {
  return McapFields()
      .Number(channel.id)
      .Number(channel.schema)
      .Text(channel.topic)
      .Text(channel.message_encoding)
      .Text("")  // no metadata
      .Record(McapOp::kChannel);
}

std::string EncodeMcap(const McapMessage& message) {
  return McapFields()
      .Number(message.channel)
      .Number(message.sequence)
      .Number(message.log_time_ns)
      .Number(message.publish_time_ns)
      .Bytes(message.data)
      .Record(McapOp::kMessage);
}

std::string EncodeMcap(const McapChunk& chunk) {
  return McapFields()
      .Number(chunk.start_time_ns)
      .Number(chunk.end_time_ns)
      .Number(chunk.uncompressed_bytes)
      .Number(chunk.uncompressed_crc)
      .Text(chunk.compression)
      .Number(std::uint64_t{chunk.records.size()})
      .Bytes(chunk.records)
      .Record(McapOp::kChunk);
}

std::string EncodeMcap(const McapChunkIndex& index) {
  return McapFields()
      .Number(index.start_time_ns)
      .Number(index.end_time_ns)
      .Number(index.chunk_at)
      .Number(index.chunk_bytes)
      .Counts(index.indexes_at)
      .Number(index.indexes_bytes)
      .Text(index.compression)
      .Number(index.compressed_bytes)
      .Number(index.uncompressed_bytes)
      .Record(McapOp::kChunkIndex);
}

std::string EncodeMcap(const McapStatistics& statistics) {
  return McapFields()
      .Number(statistics.messages)
      .Number(statistics.schemas)
      .Number(statistics.channels)
      .Number(statistics.attachments)
      .Number(statistics.metadata)
      .Number(statistics.chunks)
      .Number(statistics.start_time_ns)
      .Number(statistics.end_time_ns)
      .Counts(statistics.messages_of)
      .Record(McapOp::kStatistics);
}

bool DecodeMcap(absl::string_view fields, McapSchema& schema) {
  return Fields(fields)
      .Number(schema.id)
      .Text(schema.name)
      .Text(schema.encoding)
      .Text(schema.data)
      .ok();
}

bool DecodeMcap(absl::string_view fields, McapChannel& channel) {
  absl::string_view metadata;
  return Fields(fields)
      .Number(channel.id)
      .Number(channel.schema)
      .Text(channel.topic)
      .Text(channel.message_encoding)
      .View(metadata)
      .ok();
}

bool DecodeMcap(absl::string_view fields, McapMessage& message) {
  return Fields(fields)
      .Number(message.channel)
      .Number(message.sequence)
      .Number(message.log_time_ns)
      .Number(message.publish_time_ns)
      .Rest(message.data)
      .ok();
}

bool DecodeMcap(absl::string_view fields, McapChunk& chunk) {
  return Fields(fields)
      .Number(chunk.start_time_ns)
      .Number(chunk.end_time_ns)
      .Number(chunk.uncompressed_bytes)
      .Number(chunk.uncompressed_crc)
      .View(chunk.compression)
      .View<std::uint64_t>(chunk.records)
      .ok();
}

bool DecodeMcap(absl::string_view fields, McapChunkIndex& index) {
  return Fields(fields)
      .Number(index.start_time_ns)
      .Number(index.end_time_ns)
      .Number(index.chunk_at)
      .Number(index.chunk_bytes)
      .Counts(index.indexes_at)
      .Number(index.indexes_bytes)
      .Text(index.compression)
      .Number(index.compressed_bytes)
      .Number(index.uncompressed_bytes)
      .ok();
}

bool DecodeMcap(absl::string_view fields, McapStatistics& statistics) {
  return Fields(fields)
      .Number(statistics.messages)
      .Number(statistics.schemas)
      .Number(statistics.channels)
      .Number(statistics.attachments)
      .Number(statistics.metadata)
      .Number(statistics.chunks)
      .Number(statistics.start_time_ns)
      .Number(statistics.end_time_ns)
      .Counts(statistics.messages_of)
      .ok();
}

bool DecodeMcap(absl::string_view fields, McapFooter& footer) {
  return Fields(fields)
      .Number(footer.summary_at)
      .Number(footer.summary_offsets_at)
      .Number(footer.summary_crc)
      .ok();
}

bool TakeMcapRecord(absl::string_view& rest, McapRecord& record) {
  if (rest.size() < kMcapHeadBytes) return false;
  const auto length = LoadLittleEndian<std::uint64_t>(rest.data() + 1);
  if (length > rest.size() - kMcapHeadBytes) return false;
  record.op = static_cast<McapOp>(rest.front());
  record.fields = rest.substr(kMcapHeadBytes, length);
  rest.remove_prefix(kMcapHeadBytes + length);
  return true;
}

}  // namespace plumescout
