// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/mcap/mcap_reader.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/little_endian.h"
#include "formats/lz4_codec.h"
#include "formats/zstd_codec.h"

namespace plumescout {
namespace {

constexpr std::size_t kReadBytes = std::size_t{1} << 20;  // at a time

// The record that `map` keeps for its number, or false if it keeps another.
template <typename Record>
bool KeepSame(std::map<std::uint16_t, Record>& map, Record record) {
  const std::uint16_t id = record.id;
  const auto [kept, is_new] = map.try_emplace(id, record);
  return is_new || kept->second == record;
}

}  // namespace

McapReader::McapReader(std::string path, std::ifstream file, std::uint64_t size_bytes)
    : path_(std::move(path)), file_(std::move(file)), size_bytes_(size_bytes) {}

bool McapReader::IsMcap(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(kMcapMagic.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return file.good() && begin == kMcapMagic;
}

absl::StatusOr<McapReader> McapReader::Open(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return absl::NotFoundError(absl::StrCat(path, ": no such file"));
  }
  if (!std::filesystem::is_regular_file(status)) {
    return absl::InvalidArgumentError(absl::StrCat(path, ": not a regular file"));
  }
  const std::uint64_t size_bytes = std::filesystem::file_size(path, error);
  if (error) return absl::DataLossError(absl::StrCat(path, ": ", error.message()));
  McapReader reader(path, std::ifstream(path, std::ios::binary), size_bytes);
  PLUMESCOUT_RETURN_IF_ERROR(reader.ReadHeader());
  return reader;
}

absl::Status McapReader::ReadHeader() {
  closed_ = HasLastBytes();
  if (!Fill(kMcapMagic.size()) || buffer_ != kMcapMagic) {
    return absl::DataLossError(absl::StrCat(path_, ": no MCAP file of version 0"));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool whole, ReadRecord());
  if (!whole) return absl::DataLossError(absl::StrCat(path_, ": ends within its header"));
  McapSchema texts;  // profile and library stand where name and encoding do, but for the number
  const std::string fields =
      absl::StrCat(absl::string_view("\0\0", 2), record_.fields, absl::string_view("\0\0\0\0", 4));
  if (record_.op != McapOp::kHeader || !DecodeMcap(fields, texts)) {
    return Damage("no header");
  }
  library_ = texts.encoding;
  return absl::OkStatus();
}

// Whether the file ends as one does that was written to its end.
bool McapReader::HasLastBytes() {
  if (size_bytes_ < 2 * kMcapMagic.size()) return false;
  std::string last(kMcapMagic.size(), '\0');
  file_.seekg(static_cast<std::streamoff>(size_bytes_ - last.size()));
  file_.read(last.data(), static_cast<std::streamsize>(last.size()));
  const bool has = file_.good() && last == kMcapMagic;
  file_.clear();
  file_.seekg(0);
  return has;
}

// Reads so many bytes more into the buffer; false if the file ends before. Grows with what is
// really there: a damaged length does not allocate.
bool McapReader::Fill(std::size_t count) {
  const std::size_t begin = buffer_.size();
  while (buffer_.size() < begin + count && file_.good()) {
    const std::size_t before = buffer_.size();
    const std::size_t part = std::min(begin + count - before, kReadBytes);
    buffer_.resize(before + part);
    file_.read(buffer_.data() + before, static_cast<std::streamsize>(part));
    buffer_.resize(before + static_cast<std::size_t>(file_.gcount()));
  }
  crc_ = McapCrc(absl::string_view(buffer_).substr(begin), crc_);
  next_at_ += buffer_.size() - begin;
  return buffer_.size() == begin + count;
}

// Reads the next record; false if the file was cut off in or before it.
absl::StatusOr<bool> McapReader::ReadRecord() {
  record_at_ = next_at_;
  crc_before_ = crc_;
  buffer_.clear();
  bool whole = Fill(kMcapHeadBytes);
  if (whole) {
    const auto length = LoadLittleEndian<std::uint64_t>(buffer_.data() + 1);
    const bool fits = length <= size_bytes_ && next_at_ <= size_bytes_ - length;
    if (closed_ && !fits) {
      return Damage(absl::StrCat("a record of ", length, " bytes, beyond the end of the file"));
    }
    if (fits && length > kMcapMaxRecordBytes) {
      return Damage(absl::StrCat("a record of ", length, " bytes"));
    }
    whole = fits && Fill(length);
  }
  if (file_.bad()) return Damage("could not be read");
  absl::string_view rest = buffer_;
  if (whole && TakeMcapRecord(rest, record_)) return true;
  if (closed_) return Damage("the file has become shorter");
  torn_end_ = absl::StrCat(path_, ": cut off at byte ", record_at_, ", ",
                           size_bytes_ - std::min(size_bytes_, record_at_), " bytes left over");
  ended_ = true;
  return false;
}

absl::StatusOr<std::optional<McapMessage>> McapReader::Next() {
  if (!failed_.ok()) return failed_;
  std::optional<McapMessage> message;
  while (!message && !ended_) {
    auto read = ReadMessage();
    failed_ = read.status();
    if (!failed_.ok()) return failed_;
    message = *std::move(read);
  }
  return message;
}

// Takes one record, of the chunk that is open or of the file; a message, if it was one.
absl::StatusOr<std::optional<McapMessage>> McapReader::ReadMessage() {
  if (chunk_done_ < chunk_.size()) {
    absl::string_view rest = absl::string_view(chunk_).substr(chunk_done_);
    McapRecord record;
    if (!TakeMcapRecord(rest, record)) return Damage("a record ends beyond its chunk");
    auto taken = Take(record);
    chunk_done_ = chunk_.size() - rest.size();
    return taken;
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool whole, ReadRecord());
  if (!whole) return std::optional<McapMessage>();
  switch (record_.op) {
    case McapOp::kChunk:
      PLUMESCOUT_RETURN_IF_ERROR(OpenChunk());
      break;
    case McapOp::kDataEnd:
      PLUMESCOUT_RETURN_IF_ERROR(CheckData());
      PLUMESCOUT_RETURN_IF_ERROR(ReadSummary());
      break;
    case McapOp::kHeader:
    case McapOp::kFooter:
    case McapOp::kChunkIndex:
    case McapOp::kStatistics:
    case McapOp::kSummaryOffset:
      return Damage("a record that does not belong among the data");
    default:
      return Take(record_);
  }
  return std::optional<McapMessage>();
}

absl::StatusOr<std::optional<McapMessage>> McapReader::Take(const McapRecord& record) {
  switch (record.op) {
    case McapOp::kSchema:
      PLUMESCOUT_RETURN_IF_ERROR(TakeSchema(record));
      break;
    case McapOp::kChannel:
      PLUMESCOUT_RETURN_IF_ERROR(TakeChannel(record));
      break;
    case McapOp::kMessage:
      return TakeMessage(record);
    default:
      if (static_cast<int>(record.op) == 0) return Damage("a record of kind 0");
      break;  // of no interest here, or of a later version
  }
  return std::optional<McapMessage>();
}

absl::Status McapReader::TakeSchema(const McapRecord& record) {
  McapSchema schema;
  if (!DecodeMcap(record.fields, schema)) return Damage("a schema ends too early");
  if (schema.id == 0) return absl::OkStatus();  // readers are to pass over it
  const std::uint16_t id = schema.id;
  if (KeepSame(schemas_, std::move(schema))) return absl::OkStatus();
  return Damage(absl::StrCat("another schema ", id, " than before"));
}

absl::Status McapReader::TakeChannel(const McapRecord& record) {
  McapChannel channel;
  if (!DecodeMcap(record.fields, channel)) return Damage("a channel ends too early");
  if (channel.schema != 0 && schemas_.count(channel.schema) == 0) {
    return Damage(absl::StrCat("channel ", channel.id, " has schema ", channel.schema,
                               ", which did not come up"));
  }
  const std::uint16_t id = channel.id;
  if (KeepSame(channels_, std::move(channel))) return absl::OkStatus();
  return Damage(absl::StrCat("another channel ", id, " than before"));
}

absl::StatusOr<McapMessage> McapReader::TakeMessage(const McapRecord& record) {
  McapMessage message;
  if (!DecodeMcap(record.fields, message)) return Damage("a message ends too early");
  if (channels_.count(message.channel) == 0) {
    return Damage(
        absl::StrCat("a message of channel ", message.channel, ", which did not come up"));
  }
  ++messages_;
  return message;
}

absl::Status McapReader::OpenChunk() {
  McapChunk chunk;
  if (!DecodeMcap(record_.fields, chunk)) return Damage("a chunk ends too early");
  if (chunk.uncompressed_bytes > kMcapMaxRecordBytes) {
    return Damage(absl::StrCat("a chunk of ", chunk.uncompressed_bytes, " bytes"));
  }
  std::string records;
  if (chunk.compression == "zstd" || chunk.compression == "lz4") {
    records.resize(chunk.uncompressed_bytes);
    const absl::Status unpacked =
        chunk.compression == "zstd" ? DecompressZstd(chunk.records, records.data(), records.size())
                                    : DecompressLz4(chunk.records, records.data(), records.size());
    if (!unpacked.ok()) return Damage(unpacked.message());
  } else if (chunk.compression.empty()) {
    records.assign(chunk.records.data(), chunk.records.size());
    if (records.size() != chunk.uncompressed_bytes) {
      return Damage(absl::StrCat("a chunk has ", records.size(), " bytes, and says ",
                                 chunk.uncompressed_bytes));
    }
  } else {
    return absl::UnimplementedError(absl::StrCat(path_, ": the chunk at byte ", record_at_,
                                                 " is packed by \"", chunk.compression,
                                                 "\"; this program reads zstd and lz4"));
  }
  if (chunk.uncompressed_crc != 0 && McapCrc(records) != chunk.uncompressed_crc) {
    return Damage("checksum mismatch of a chunk");
  }
  chunk_ = std::move(records);
  chunk_at_ = record_at_;
  chunk_done_ = 0;
  chunks_[record_at_] = buffer_.size();
  return absl::OkStatus();
}

absl::Status McapReader::CheckData() {
  if (record_.fields.size() < sizeof(std::uint32_t)) return Damage("the data's end is cut short");
  const auto crc = LoadLittleEndian<std::uint32_t>(record_.fields.data());
  if (crc != 0 && crc != crc_before_) return Damage("checksum mismatch of the data");
  return absl::OkStatus();
}

// Reads on, from behind the data to the end of the file.
absl::Status McapReader::ReadSummary() {
  const std::uint64_t summary_at = next_at_;
  crc_ = 0;
  do {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool whole, ReadRecord());
    if (!whole) return absl::OkStatus();
    PLUMESCOUT_RETURN_IF_ERROR(CheckSummaryRecord());
  } while (record_.op != McapOp::kFooter);
  PLUMESCOUT_RETURN_IF_ERROR(CheckFooter(summary_at, crc_before_));
  buffer_.clear();
  record_at_ = next_at_;
  if (!Fill(kMcapMagic.size()) || buffer_ != kMcapMagic || next_at_ < size_bytes_) {
    if (closed_) return Damage("more follows the footer than the file's last bytes");
    torn_end_ = absl::StrCat(path_, ": cut off at byte ", record_at_, ", behind the footer");
  }
  ended_ = true;
  return absl::OkStatus();
}

absl::Status McapReader::CheckSummaryRecord() {
  switch (record_.op) {
    case McapOp::kSchema:
      return TakeSchema(record_);
    case McapOp::kChannel:
      return TakeChannel(record_);
    case McapOp::kStatistics: {
      McapStatistics statistics;
      if (!DecodeMcap(record_.fields, statistics)) return Damage("statistics end too early");
      if (statistics.messages == messages_ && statistics.chunks == chunks_.size()) break;
      return Damage(absl::StrCat("statistics tell of ", statistics.messages, " messages and ",
                                 statistics.chunks, " chunks; there are ", messages_, " and ",
                                 chunks_.size()));
    }
    case McapOp::kChunkIndex: {
      McapChunkIndex index;
      if (!DecodeMcap(record_.fields, index)) return Damage("a chunk's index ends too early");
      const auto chunk = chunks_.find(index.chunk_at);
      if (chunk != chunks_.end() && chunk->second == index.chunk_bytes) break;
      return Damage(absl::StrCat("no chunk of ", index.chunk_bytes, " bytes stands at byte ",
                                 index.chunk_at));
    }
    case McapOp::kHeader:
    case McapOp::kMessage:
    case McapOp::kChunk:
    case McapOp::kMessageIndex:
    case McapOp::kDataEnd:
      return Damage("a record that does not belong into the summary");
    default:
      break;
  }
  return absl::OkStatus();
}

absl::Status McapReader::CheckFooter(std::uint64_t summary_at, std::uint32_t crc_before) {
  McapFooter footer;
  if (!DecodeMcap(record_.fields, footer)) return Damage("the footer ends too early");
  const bool has_summary = record_at_ > summary_at;
  if (footer.summary_at != (has_summary ? summary_at : 0)) {
    return Damage(absl::StrCat("the footer has the summary at byte ", footer.summary_at));
  }
  const absl::string_view covered =
      absl::string_view(buffer_).substr(0, kMcapHeadBytes + 2 * sizeof(std::uint64_t));
  if (footer.summary_crc != 0 && footer.summary_crc != McapCrc(covered, crc_before)) {
    return Damage("checksum mismatch of the summary");
  }
  return absl::OkStatus();
}

double McapReader::share_read() const {
  if (next_at_ >= size_bytes_) return 1.0;
  return static_cast<double>(next_at_) / static_cast<double>(size_bytes_);
}

absl::Status McapReader::Damage(absl::string_view why) const {
  const bool in_chunk = chunk_done_ < chunk_.size();
  return absl::DataLossError(
      in_chunk ? absl::StrCat(path_, ": ", why, ", in the chunk at byte ", chunk_at_, ", at byte ",
                              chunk_done_, " of what it unpacks to")
               : absl::StrCat(path_, ": ", why, ", in the record at byte ", record_at_));
}

}  // namespace plumescout
