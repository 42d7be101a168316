// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "formats/mcap/mcap_records.h"

namespace plumescout {

enum class McapCompression { kNone, kZstd };

// The bytes of an MCAP file, piece by piece, for whoever writes or sends them:
//
//   magic | header | chunks, each followed by an index of its messages by channel | data end with a
//   CRC of all before it | schemas, channels, statistics, chunk indexes | offsets of these groups |
//   footer with a CRC of the summary | magic
//
// A chunk holds schemas and channels that came up in it, and messages in the order in which they
// were added. Memory: a chunk, its packed bytes until they are taken, and for the file some 100
// bytes a chunk. The same calls give the same bytes. Single-threaded.
class McapEncoder {
 public:
  // A chunk is closed when it has so many bytes. Of fields that repeat from frame to frame, zstd
  // finds the last frame within the same chunk only.
  static constexpr std::size_t kChunkBytes = std::size_t{4} << 20;

  // `library` is who writes.
  explicit McapEncoder(absl::string_view library,
                       McapCompression compression = McapCompression::kZstd,
                       std::size_t chunk_bytes = kChunkBytes);

  // Their numbers, 1, 2, 3 ... REQUIRES: not finished; fewer than 2^16 of each.
  std::uint16_t AddSchema(absl::string_view name, absl::string_view encoding,
                          absl::string_view data);
  std::uint16_t AddChannel(absl::string_view topic, absl::string_view message_encoding,
                           std::uint16_t schema);

  // kInternal if zstd fails. REQUIRES: the channel was added; not finished.
  absl::Status Add(const McapMessage& message);
  // Closes the chunk that is open, if anything is in it: what was added so far can then be read
  // whatever becomes of the rest. Errors as of Add.
  absl::Status EndChunk();
  // The file ends here. Errors as of Add.
  absl::Status Finish();

  // The bytes that are ready and were not taken yet.
  std::string Take() { return std::exchange(ready_, std::string()); }
  std::size_t ready_bytes() const { return ready_.size(); }

 private:
  // Of the messages of a channel in the chunk: log time, and the record's place among the records.
  using MessagePlaces = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

  void Emit(absl::string_view bytes);
  absl::Status CloseChunk();
  std::string Summary(std::uint64_t begin, std::uint64_t& offsets_at) const;

  const McapCompression compression_;
  const std::size_t chunk_bytes_;
  std::string ready_;
  std::uint64_t at_ = 0;   // bytes of the file so far
  std::uint32_t crc_ = 0;  // of these
  std::string chunk_;      // records of the chunk that is open
  McapChunkIndex open_;    // what is known of it
  std::map<std::uint16_t, MessagePlaces> places_;
  std::vector<McapSchema> schemas_;
  std::vector<McapChannel> channels_;
  std::vector<McapChunkIndex> chunks_;
  McapStatistics statistics_;
};

}  // namespace plumescout
