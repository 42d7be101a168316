// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/recording.h"

#include <google/protobuf/util/json_util.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "lab/about/about.h"
#include "lab/program/robot_run.h"
#include "proto/convert/options.h"

namespace plumescout::lab {
namespace {

// A prior map of 16 million cells at worst, deflated, in base 64.
constexpr std::uint64_t kMaxOptionsBytes = std::uint64_t{1} << 25;

// Of recordings that do not hold their options.
std::string OptionsPath(const std::string& path) { return absl::StrCat(path, ".options.json"); }

absl::StatusOr<MissionOptions> ReadOptionsFile(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string json, ReadFile(path, kMaxOptionsBytes));
  v1::MissionOptions proto;
  const auto read = google::protobuf::util::JsonStringToMessage(json, &proto);
  if (!read.ok()) return absl::InvalidArgumentError(absl::StrCat(path, ": ", read.ToString()));
  return FromProto(proto, RecordedDefaults(), path);
}

absl::StatusOr<MissionOptions> ParseOptions(const std::string& bytes, const std::string& path) {
  v1::MissionOptions proto;
  if (!proto.ParseFromString(bytes)) {
    return absl::InvalidArgumentError(absl::StrCat(path, ": event 0 holds no options"));
  }
  return FromProto(proto, MissionOptions{}, path);
}

}  // namespace

absl::StatusOr<Recorder> Recorder::Create(const std::string& path, const MissionOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(folder.string()));
  std::error_code ignored;  // what cannot be removed is in the way of Create
  std::filesystem::remove(path, ignored);
  std::filesystem::remove(OptionsPath(path), ignored);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      JournalFileWriter writer,
      JournalFileWriter::Create(path, {.code_version = CodeVersion(),
                                       .mission_options = ToProto(options).SerializeAsString()}));
  return Recorder(std::move(writer));
}

void Recorder::Record(const Event& event) {
  if (status_.ok()) status_ = writer_.Append(event);
}

Recording::Recording(Reader reader, MissionOptions options)
    : reader_(std::move(reader)), options_(std::move(options)) {
  const std::optional<JournalStart> start =
      std::visit([](const auto& of) { return of.start(); }, reader_);
  start_ = start ? *start : JournalStart{.mission_options = ToProto(options_).SerializeAsString()};
}

absl::StatusOr<Recording::Reader> Recording::OpenReader(const std::string& path) {
  if (!McapReader::IsMcap(path)) return JournalFileReader::Open(path);
  absl::StatusOr<McapJournalReader> reader = McapJournalReader::Open(path);
  if (reader.ok()) return *std::move(reader);
  const auto run = RobotRun::Open(path);
  if (!run.ok() || !*run) return reader.status();
  return absl::InvalidArgumentError(
      absl::StrCat(path, ": is what robot ", (*run)->robot(),
                   " has recorded; plumescout-lab ingest makes a mission of it"));
}

absl::StatusOr<Recording> Recording::Open(const std::string& path) {
  PLUMESCOUT_ASSIGN_OR_RETURN(Reader reader, OpenReader(path));
  const std::optional<JournalStart> start =
      std::visit([](const auto& of) { return of.start(); }, reader);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      MissionOptions options,
      start ? ParseOptions(start->mission_options, path) : ReadOptionsFile(OptionsPath(path)));
  return Recording(std::move(reader), std::move(options));
}

absl::StatusOr<std::optional<Event>> Recording::Next() {
  return std::visit([](auto& of) { return of.Next(); }, reader_);
}

const std::string& Recording::torn_end() const {
  return std::visit([](const auto& of) -> const std::string& { return of.torn_end(); }, reader_);
}

double Recording::share_read() const {
  return std::visit([](const auto& of) { return of.share_read(); }, reader_);
}

std::string VersionRemark(const std::string& code_version) {
  if (code_version.empty()) return "recorded by an older version\n";
  if (code_version == CodeVersion()) return "";
  return absl::StrCat("recorded by version ", code_version, ", this is ", CodeVersion(), "\n");
}

std::string EndRemark(const Recording& recording) {
  return recording.torn_end().empty() ? "" : absl::StrCat(recording.torn_end(), "\n");
}

absl::StatusOr<std::unique_ptr<Mission>> Replay(Recording& recording, std::int64_t revision,
                                                const std::function<void(double)>& progress) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<Mission> mission,
                              Mission::Create(recording.options()));
  std::optional<Event> event;
  do {
    if (progress) {
      progress(revision > 0
                   ? static_cast<double>(mission->revision()) / static_cast<double>(revision)
                   : recording.share_read());
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(event, recording.Next());
    if (!event) break;
    const absl::StatusOr<Applied> applied = mission->Apply(event->body);
    if (!applied.ok() || applied->revision != event->number) {
      return absl::DataLossError(
          absl::StrCat("event ", event->number, " does not follow: ", applied.status().message()));
    }
  } while (mission->revision() != revision);
  if (revision != 0 && mission->revision() != revision) {
    return absl::OutOfRangeError(absl::StrCat(
        "revision ", revision, " is not in the recording, which ends at ", mission->revision()));
  }
  return mission;
}

}  // namespace plumescout::lab
