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
  return FromProto(proto, MissionOptions{}, path);
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
      EventLogWriter writer,
      EventLogWriter::Create(path, {CodeVersion(), ToProto(options).SerializeAsString()}));
  return Recorder(std::move(writer));
}

void Recorder::Record(const Event& event) {
  if (status_.ok()) status_ = writer_.Append(event);
}

absl::StatusOr<Recording> ReadRecording(const std::string& path) {
  Recording recording;
  PLUMESCOUT_ASSIGN_OR_RETURN(EventLog log, ReadEventLog(path));
  PLUMESCOUT_ASSIGN_OR_RETURN(recording.options,
                              log.start ? ParseOptions(log.start->mission_options, path)
                                        : ReadOptionsFile(OptionsPath(path)));
  if (log.start) recording.code_version = std::move(log.start->code_version);
  recording.events = std::move(log.events);
  recording.end = std::move(log.end);
  return recording;
}

std::string Remarks(const Recording& recording) {
  std::string remarks;
  if (!recording.end.ok()) absl::StrAppend(&remarks, recording.end.message(), "\n");
  if (recording.code_version.empty()) {
    absl::StrAppend(&remarks, "recorded by an older version\n");
  } else if (recording.code_version != CodeVersion()) {
    absl::StrAppend(&remarks, "recorded by version ", recording.code_version, ", this is ",
                    CodeVersion(), "\n");
  }
  return remarks;
}

absl::StatusOr<std::unique_ptr<Mission>> Replay(const Recording& recording, std::int64_t revision,
                                                const std::function<void(double)>& progress) {
  const auto last = static_cast<std::int64_t>(recording.events.size());
  if (revision < 0 || revision > last) {
    return absl::OutOfRangeError(
        absl::StrCat("revision ", revision, " is not in the recording, which ends at ", last));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<Mission> mission, Mission::Create(recording.options));
  const std::int64_t end = revision > 0 ? revision : last;
  for (std::int64_t i = 0; i < end; ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(end));
    const Event& event = recording.events[static_cast<std::size_t>(i)];
    const absl::StatusOr<Applied> applied = mission->Apply(event.body);
    if (!applied.ok() || applied->revision != event.number) {
      return absl::DataLossError(
          absl::StrCat("event ", event.number, " does not follow: ", applied.status().message()));
    }
  }
  return mission;
}

}  // namespace plumescout::lab
