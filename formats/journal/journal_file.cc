// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/journal/journal_file.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/crc32c.h"
#include "formats/journal/event_codec_v4.h"
#include "formats/little_endian.h"

namespace plumescout {
namespace {

constexpr std::uint32_t kLastVersionWithoutChain = 4;
constexpr std::uint32_t kVersionWithoutStart = 3;  // the oldest that is read
constexpr std::size_t kFileHeaderBytes = 12;       // magic and version
constexpr std::size_t kRecordHeaderBytes = 12;
constexpr std::size_t kRecordHeaderBytes4 = 8;            // of versions without a chain
constexpr std::size_t kReadBytes = std::size_t{1} << 20;  // at a time

static_assert(kJournalMagic.size() + sizeof(kJournalFileVersion) == kFileHeaderBytes);

absl::string_view BytesOf(const std::uint32_t& value) {
  return absl::string_view(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace

JournalFileWriter::JournalFileWriter(std::string path, std::ofstream file)
    : path_(std::move(path)), file_(std::move(file)) {}

absl::StatusOr<JournalFileWriter> JournalFileWriter::Create(const std::string& path,
                                                            const JournalStart& start) {
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    return absl::AlreadyExistsError(absl::StrCat(path, ": there is such a file"));
  }
  std::ofstream file(path, std::ios::binary);
  JournalFileWriter writer(path, std::move(file));
  PLUMESCOUT_RETURN_IF_ERROR(writer.Write(writer.encoder_.Begin(start)));
  return writer;
}

absl::Status JournalFileWriter::Append(const Event& event, PlanDetail detail) {
  const std::string body = EncodeEvent(event, detail);
  if (body.size() > kMaxJournalBodyBytes) {
    return absl::InvalidArgumentError(absl::StrCat(path_, ": event of ", body.size(), " bytes"));
  }
  return Write(encoder_.Record(body));
}

absl::Status JournalFileWriter::Write(absl::string_view bytes) {
  file_ << bytes << std::flush;
  if (!file_) return absl::UnavailableError(absl::StrCat(path_, ": could not be written"));
  return absl::OkStatus();
}

JournalFileReader::JournalFileReader(std::string path, std::ifstream file, std::uint64_t size_bytes)
    : path_(std::move(path)), file_(std::move(file)), size_bytes_(size_bytes) {}

absl::StatusOr<JournalFileReader> JournalFileReader::Open(const std::string& path) {
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
  JournalFileReader reader(path, std::ifstream(path, std::ios::binary), size_bytes);
  PLUMESCOUT_RETURN_IF_ERROR(reader.ReadHeader());
  if (reader.version_ != kVersionWithoutStart) PLUMESCOUT_RETURN_IF_ERROR(reader.ReadStart());
  return reader;
}

absl::Status JournalFileReader::ReadHeader() {
  const bool whole = Fill(kFileHeaderBytes) == kFileHeaderBytes;
  if (!whole || absl::string_view(buffer_).substr(0, kJournalMagic.size()) != kJournalMagic) {
    return absl::DataLossError(absl::StrCat(path_, ": no journal"));
  }
  version_ = LoadLittleEndian<std::uint32_t>(buffer_.data() + kJournalMagic.size());
  if (version_ < kVersionWithoutStart || version_ > kJournalFileVersion) {
    return absl::InvalidArgumentError(absl::StrCat(path_, ": version ", version_,
                                                   ", this program reads ", kVersionWithoutStart,
                                                   " to ", kJournalFileVersion));
  }
  crc_ = Crc32c(buffer_);
  return absl::OkStatus();
}

absl::Status JournalFileReader::ReadStart() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool whole, ReadBody());
  if (!whole) {
    return absl::DataLossError(absl::StrCat(path_, ": ends within event 0, the mission's options"));
  }
  absl::StatusOr<JournalStart> start =
      version_ > kLastVersionWithoutChain ? DecodeStart(buffer_) : DecodeStartV4(buffer_);
  if (!start.ok()) return Damage(absl::StrCat("event 0: ", start.status().message()));
  start_ = *std::move(start);
  return absl::OkStatus();
}

// Reads the next bytes into the buffer, fewer where the file ends; says how many. Grows with what
// is really there: a damaged length does not allocate.
std::size_t JournalFileReader::Fill(std::size_t count) {
  buffer_.clear();
  while (buffer_.size() < count && file_.good()) {
    const std::size_t before = buffer_.size();
    const std::size_t part = std::min(count - before, kReadBytes);
    buffer_.resize(before + part);
    file_.read(buffer_.data() + before, static_cast<std::streamsize>(part));
    buffer_.resize(before + static_cast<std::size_t>(file_.gcount()));
  }
  next_at_ += buffer_.size();
  return buffer_.size();
}

// Reads the body of the next record into the buffer; false if the file ends.
absl::StatusOr<bool> JournalFileReader::ReadBody() {
  const bool chained = version_ > kLastVersionWithoutChain;
  const std::size_t header_bytes = chained ? kRecordHeaderBytes : kRecordHeaderBytes4;
  record_at_ = next_at_;
  const auto end = [this](const char* torn) -> absl::StatusOr<bool> {
    if (file_.bad()) return Damage("could not be read");
    if (next_at_ > record_at_) {
      torn_end_ = absl::StrCat(path_, ": torn ", torn, " at byte ", record_at_, ", ",
                               next_at_ - record_at_, " bytes left over");
    }
    ended_ = true;
    return false;
  };
  if (Fill(header_bytes) < header_bytes) return end("header of a record");
  const auto length = LoadLittleEndian<std::uint32_t>(buffer_.data());
  const auto body_crc =
      LoadLittleEndian<std::uint32_t>(buffer_.data() + header_bytes - sizeof(std::uint32_t));
  const std::uint32_t length_crc = Crc32c(BytesOf(length), chained ? crc_ : 0);
  if (chained && LoadLittleEndian<std::uint32_t>(buffer_.data() + sizeof(length)) != length_crc) {
    return Damage("checksum mismatch of a record's length");
  }
  if (length > kMaxJournalBodyBytes) return Damage(absl::StrCat("a record of ", length, " bytes"));
  if (Fill(length) < length) return end("record");
  crc_ = Crc32c(buffer_, length_crc);
  if (crc_ != body_crc) return Damage("checksum mismatch");
  return true;
}

absl::StatusOr<std::optional<Event>> JournalFileReader::ReadEvent() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const bool whole, ReadBody());
  if (!whole) return std::optional<Event>();
  absl::StatusOr<Event> event =
      version_ > kLastVersionWithoutChain ? DecodeEvent(buffer_) : DecodeEventV4(buffer_);
  if (!event.ok()) return Damage(event.status().message());
  return std::optional<Event>(*std::move(event));
}

absl::StatusOr<std::optional<Event>> JournalFileReader::Next() {
  if (!failed_.ok()) return failed_;
  if (ended_) return std::optional<Event>();
  absl::StatusOr<std::optional<Event>> event = ReadEvent();
  failed_ = event.status();
  return event;
}

double JournalFileReader::share_read() const {
  if (next_at_ >= size_bytes_) return 1.0;
  return static_cast<double>(next_at_) / static_cast<double>(size_bytes_);
}

absl::Status JournalFileReader::Damage(absl::string_view why) const {
  const std::uint64_t left = size_bytes_ > record_at_ ? size_bytes_ - record_at_ : 0;
  return absl::DataLossError(absl::StrCat(path_, ": ", why, ", in the record at byte ", record_at_,
                                          "; ", left, " bytes not read"));
}

}  // namespace plumescout
