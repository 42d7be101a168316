// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/mcap/mcap_encoder.h"

#include <algorithm>

#include "absl/status/statusor.h"
#include "core/types/status_macros.h"
#include "formats/zstd_codec.h"

namespace plumescout {
namespace {

constexpr char kZstd[] = "zstd";
// Some 5 % less than the library's own, for twice its time; from there on bytes get dear.
constexpr int kLevel = 6;

// What spans the messages that a chunk or file has had so far, and one more.
template <typename Span>
void Widen(Span& span, bool is_first, std::uint64_t time_ns) {
  span.start_time_ns = is_first ? time_ns : std::min(span.start_time_ns, time_ns);
  span.end_time_ns = is_first ? time_ns : std::max(span.end_time_ns, time_ns);
}

template <typename Record>
std::string EncodeAll(const std::vector<Record>& records) {
  std::string bytes;
  for (const Record& record : records) bytes += EncodeMcap(record);
  return bytes;
}

}  // namespace

McapEncoder::McapEncoder(absl::string_view library, McapCompression compression,
                         std::size_t chunk_bytes)
    : compression_(compression), chunk_bytes_(chunk_bytes) {
  Emit(kMcapMagic);
  Emit(McapFields().Text("").Text(library).Record(McapOp::kHeader));
}

std::uint16_t McapEncoder::AddSchema(absl::string_view name, absl::string_view encoding,
                                     absl::string_view data) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back({id, std::string(name), std::string(encoding), std::string(data)});
  chunk_ += EncodeMcap(schemas_.back());
  return id;
}

std::uint16_t McapEncoder::AddChannel(absl::string_view topic, absl::string_view message_encoding,
                                      std::uint16_t schema) {
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  channels_.push_back({id, schema, std::string(topic), std::string(message_encoding)});
  chunk_ += EncodeMcap(channels_.back());
  return id;
}

absl::Status McapEncoder::Add(const McapMessage& message) {
  Widen(open_, places_.empty(), message.log_time_ns);
  Widen(statistics_, statistics_.messages == 0, message.log_time_ns);
  ++statistics_.messages;
  ++statistics_.messages_of[message.channel];
  places_[message.channel].emplace_back(message.log_time_ns, chunk_.size());
  chunk_ += EncodeMcap(message);
  return chunk_.size() < chunk_bytes_ ? absl::OkStatus() : CloseChunk();
}

absl::Status McapEncoder::EndChunk() { return chunk_.empty() ? absl::OkStatus() : CloseChunk(); }

absl::Status McapEncoder::CloseChunk() {
  std::string packed;
  if (compression_ == McapCompression::kZstd) {
    PLUMESCOUT_ASSIGN_OR_RETURN(packed, CompressZstd(chunk_, kLevel));
    open_.compression = kZstd;
  }
  const std::string& records = compression_ == McapCompression::kZstd ? packed : chunk_;
  open_.uncompressed_bytes = chunk_.size();
  open_.compressed_bytes = records.size();
  open_.chunk_at = at_;
  Emit(EncodeMcap(McapChunk{open_.start_time_ns, open_.end_time_ns, chunk_.size(), McapCrc(chunk_),
                            open_.compression, records}));
  open_.chunk_bytes = at_ - open_.chunk_at;
  const std::uint64_t indexes_at = at_;
  for (const auto& [channel, places] : places_) {
    open_.indexes_at[channel] = at_;
    McapFields fields;
    fields.Number(channel).Number(
        static_cast<std::uint32_t>(places.size() * 2 * sizeof(std::uint64_t)));
    for (const auto& [time_ns, offset] : places) fields.Number(time_ns).Number(offset);
    Emit(fields.Record(McapOp::kMessageIndex));
  }
  open_.indexes_bytes = at_ - indexes_at;
  chunks_.push_back(std::exchange(open_, McapChunkIndex()));
  ++statistics_.chunks;
  chunk_.clear();
  places_.clear();
  return absl::OkStatus();
}

// The summary and the offsets of its groups, as they stand from byte `begin` on.
std::string McapEncoder::Summary(std::uint64_t begin, std::uint64_t& offsets_at) const {
  const std::pair<McapOp, std::string> groups[] = {
      {McapOp::kSchema, EncodeAll(schemas_)},
      {McapOp::kChannel, EncodeAll(channels_)},
      {McapOp::kStatistics, EncodeMcap(statistics_)},
      {McapOp::kChunkIndex, EncodeAll(chunks_)},
  };
  std::string summary;
  std::string offsets;
  for (const auto& [op, records] : groups) {
    if (records.empty()) continue;
    offsets += McapFields()
                   .Number(static_cast<std::uint8_t>(op))
                   .Number(begin + summary.size())
                   .Number(std::uint64_t{records.size()})
                   .Record(McapOp::kSummaryOffset);
    summary += records;
  }
  offsets_at = begin + summary.size();
  return summary + offsets;
}

absl::Status McapEncoder::Finish() {
  PLUMESCOUT_RETURN_IF_ERROR(EndChunk());
  statistics_.schemas = static_cast<std::uint16_t>(schemas_.size());
  statistics_.channels = static_cast<std::uint32_t>(channels_.size());
  Emit(McapFields().Number(crc_).Record(McapOp::kDataEnd));
  const std::uint64_t summary_at = at_;
  std::uint64_t offsets_at = 0;
  const std::string summary = Summary(summary_at, offsets_at);
  // The CRC of the summary goes on over the footer, up to where it is kept itself.
  McapFields footer;
  footer.Number(summary_at).Number(offsets_at).Number(std::uint32_t{0});
  const std::string unsigned_footer = footer.Record(McapOp::kFooter);
  const absl::string_view covered =
      absl::string_view(unsigned_footer).substr(0, unsigned_footer.size() - sizeof(std::uint32_t));
  const std::uint32_t crc = McapCrc(covered, McapCrc(summary));
  Emit(summary);
  Emit(covered);
  Emit(McapFields().Number(crc).bytes());
  Emit(kMcapMagic);
  return absl::OkStatus();
}

void McapEncoder::Emit(absl::string_view bytes) {
  absl::StrAppend(&ready_, bytes);
  at_ += bytes.size();
  crc_ = McapCrc(bytes, crc_);
}

}  // namespace plumescout
