// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "formats/mcap/mcap_records.h"

namespace plumescout {

// No record that is read is longer, and no chunk unpacks to more.
inline constexpr std::uint64_t kMcapMaxRecordBytes = std::uint64_t{1} << 29;

// Reads an MCAP file from its beginning to its end, and holds one record at a time, of chunks also
// what they unpack to. Chunks may be packed by zstd or lz4, or not at all. Attachments, metadata
// and records that are not known are passed over. Every CRC that the file has is checked: that of a
// chunk before its messages are given out, those of the data and the summary when the reader comes
// to them. So are the numbers in the summary that the reader has counted itself. Not thread-safe.
class McapReader {
 public:
  // Reads the header. Errors, naming the file: kNotFound; kDataLoss if it is no MCAP file;
  // kInvalidArgument for what is no regular file.
  static absl::StatusOr<McapReader> Open(const std::string& path);
  // Whether the file begins as one does.
  static bool IsMcap(const std::string& path);

  const std::string& library() const { return library_; }
  // Those that came up so far, by number.
  const std::map<std::uint16_t, McapSchema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, McapChannel>& channels() const { return channels_; }

  // The next message, as they stand in the file; nothing once it ends. A file that was cut off, and
  // so lacks its last bytes, is an end too, after the last whole record: see torn_end(). Any other
  // damage is kDataLoss, and a compression that is not known kUnimplemented, both naming file, byte
  // and reason, now and whenever asked again. (Of a file that was cut off, a damaged length cannot
  // be told from the cut.)
  absl::StatusOr<std::optional<McapMessage>> Next();

  // Where the file was cut off, as a sentence without a full stop. Empty: it is whole, or Next has
  // not come to its end.
  const std::string& torn_end() const { return torn_end_; }
  // How much of the file, as long as it was when it was opened, has been read. [0, 1]
  double share_read() const;

 private:
  McapReader(std::string path, std::ifstream file, std::uint64_t size_bytes);

  absl::Status ReadHeader();
  bool HasLastBytes();
  bool Fill(std::size_t count);
  absl::StatusOr<bool> ReadRecord();
  absl::StatusOr<std::optional<McapMessage>> ReadMessage();
  absl::StatusOr<std::optional<McapMessage>> Take(const McapRecord& record);
  absl::Status TakeSchema(const McapRecord& record);
  absl::Status TakeChannel(const McapRecord& record);
  absl::StatusOr<McapMessage> TakeMessage(const McapRecord& record);
  absl::Status OpenChunk();
  absl::Status CheckData();
  absl::Status ReadSummary();
  absl::Status CheckSummaryRecord();
  absl::Status CheckFooter(std::uint64_t summary_at, std::uint32_t crc_before);
  absl::Status Damage(absl::string_view why) const;

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_bytes_;
  bool closed_ = false;  // its last bytes are those of a file that is whole
  std::string library_;
  std::map<std::uint16_t, McapSchema> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;

  std::uint64_t record_at_ = 0;   // where the record that is being read begins
  std::uint64_t next_at_ = 0;     // where it ends
  std::uint32_t crc_ = 0;         // of all that stands before next_at_ ...
  std::uint32_t crc_before_ = 0;  // ... and before record_at_; in the summary, from where it begins
  std::string buffer_;            // the record
  McapRecord record_;             // in it

  std::string chunk_;  // the records of the chunk that is being read
  std::uint64_t chunk_at_ = 0;
  std::size_t chunk_done_ = 0;                     // bytes of `chunk_` that were read
  std::map<std::uint64_t, std::uint64_t> chunks_;  // bytes of the records, by place
  std::uint64_t messages_ = 0;

  bool ended_ = false;
  absl::Status failed_;
  std::string torn_end_;
};

}  // namespace plumescout
