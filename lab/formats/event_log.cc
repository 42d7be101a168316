// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/event_log.h"

#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "lab/formats/crc32c.h"
#include "lab/formats/little_endian.h"

namespace plumescout::lab {
namespace {

constexpr absl::string_view kMagic = "\x89PSEVLOG";
constexpr std::uint32_t kVersion = 4;
constexpr std::uint32_t kVersionWithoutStart = 3;
constexpr std::size_t kHeaderBytes = 12;  // magic and version
constexpr std::size_t kRecordHeaderBytes = 8;
constexpr std::uint32_t kMaxBodyBytes = std::uint32_t{1} << 28;
constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 32;

static_assert(kMagic.size() + sizeof(kVersion) == kHeaderBytes);

absl::string_view BytesOf(const std::uint32_t& value) {
  return absl::string_view(reinterpret_cast<const char*>(&value), sizeof(value));
}

// The body of the record at the front of `rest`, which moves behind it.
absl::StatusOr<absl::string_view> NextBody(absl::string_view& rest) {
  if (rest.size() < kRecordHeaderBytes) return absl::DataLossError("torn record header");
  const auto length = LoadLittleEndian<std::uint32_t>(rest.data());
  const auto crc = LoadLittleEndian<std::uint32_t>(rest.data() + sizeof(length));
  if (rest.size() - kRecordHeaderBytes < length) return absl::DataLossError("torn record");
  const absl::string_view body = rest.substr(kRecordHeaderBytes, length);
  if (Crc32c(body, Crc32c(BytesOf(length))) != crc) return absl::DataLossError("checksum mismatch");
  rest.remove_prefix(kRecordHeaderBytes + length);
  return body;
}

// Likewise, decoded; `rest` stays if that fails.
template <typename Decode>
auto NextDecoded(absl::string_view& rest, Decode decode) -> decltype(decode(rest)) {
  absl::string_view behind = rest;
  PLUMESCOUT_ASSIGN_OR_RETURN(const absl::string_view body, NextBody(behind));
  auto decoded = decode(body);
  if (decoded.ok()) rest = behind;
  return decoded;
}

}  // namespace

EventLogWriter::EventLogWriter(std::string path, std::ofstream file)
    : path_(std::move(path)), file_(std::move(file)) {}

absl::StatusOr<EventLogWriter> EventLogWriter::Create(const std::string& path,
                                                      const RecordingStart& start) {
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    return absl::AlreadyExistsError(absl::StrCat(path, ": there is such a file"));
  }
  std::ofstream file(path, std::ios::binary);
  file << kMagic << BytesOf(kVersion) << std::flush;
  EventLogWriter writer(path, std::move(file));
  PLUMESCOUT_RETURN_IF_ERROR(writer.AppendBody(EncodeStart(start)));
  return writer;
}

absl::Status EventLogWriter::Append(const Event& event) { return AppendBody(EncodeEvent(event)); }

absl::Status EventLogWriter::AppendBody(const std::string& body) {
  if (body.size() > kMaxBodyBytes) {
    return absl::InvalidArgumentError(absl::StrCat(path_, ": event of ", body.size(), " bytes"));
  }
  const auto length = static_cast<std::uint32_t>(body.size());
  const std::uint32_t crc = Crc32c(body, Crc32c(BytesOf(length)));
  file_ << BytesOf(length) << BytesOf(crc) << body << std::flush;
  if (!file_) return absl::UnavailableError(absl::StrCat(path_, ": could not be written"));
  return absl::OkStatus();
}

absl::StatusOr<EventLog> ReadEventLog(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMaxFileBytes));
  if (bytes.size() < kHeaderBytes || !absl::StartsWith(bytes, kMagic)) {
    return absl::DataLossError(absl::StrCat(path, ": no event log"));
  }
  const auto version = LoadLittleEndian<std::uint32_t>(bytes.data() + kMagic.size());
  if (version != kVersion && version != kVersionWithoutStart) {
    return absl::InvalidArgumentError(absl::StrCat(path, ": version ", version,
                                                   ", this program reads ", kVersionWithoutStart,
                                                   " and ", kVersion));
  }
  EventLog log;
  absl::string_view rest = absl::string_view(bytes).substr(kHeaderBytes);
  if (version != kVersionWithoutStart) {
    absl::StatusOr<RecordingStart> start = NextDecoded(rest, DecodeStart);
    if (!start.ok()) {
      return absl::DataLossError(
          absl::StrCat(path, ": event 0, the mission's options: ", start.status().message()));
    }
    log.start = *std::move(start);
  }
  while (!rest.empty() && log.end.ok()) {
    absl::StatusOr<Event> event = NextDecoded(rest, DecodeEvent);
    if (event.ok()) {
      log.events.push_back(*std::move(event));
    } else {
      log.end = absl::DataLossError(absl::StrCat(path, ": ", event.status().message(), " at byte ",
                                                 bytes.size() - rest.size(), ", ", rest.size(),
                                                 " bytes not read"));
    }
  }
  return log;
}

}  // namespace plumescout::lab
