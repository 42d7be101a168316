// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/log_store.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <system_error>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/log_replay.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"

namespace plumescout::client {
namespace {

namespace fs = std::filesystem;

constexpr absl::string_view kSegmentPrefix = "log-";
constexpr std::uint64_t kMaxSegmentFile_bytes = std::uint64_t{1} << 32;

std::string SegmentPath(const std::string& folder, std::int64_t number) {
  return absl::StrFormat("%s/%s%08d", folder, kSegmentPrefix, number);
}

// The segments of a folder by number.
absl::StatusOr<std::map<std::int64_t, std::string>> ListSegments(const std::string& folder) {
  std::map<std::int64_t, std::string> paths;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    std::int64_t number = 0;
    if (absl::StartsWith(name, kSegmentPrefix) &&
        absl::SimpleAtoi(absl::string_view(name).substr(kSegmentPrefix.size()), &number)) {
      paths.emplace(number, it->path().string());
    }
  }
  if (error) return absl::UnavailableError(absl::StrCat(folder, ": ", error.message()));
  return paths;
}

// The last number of a segment after a later one has renumbered all.
std::int64_t Renumbered(std::int64_t last_sequence, const Renumbering& renumbering) {
  return std::max(last_sequence, renumbering.from - 1) + renumbering.to - renumbering.from;
}

// Reads the segments of a folder.
class SegmentReader {
 public:
  SegmentReader(MissionId mission, RobotId robot) : replay_(std::move(mission), std::move(robot)) {}

  absl::Status ReadAll(const std::map<std::int64_t, std::string>& paths) {
    for (const auto& [number, path] : paths) {
      if (!segments.empty() && number != number_ + 1) {
        Damaged(path, absl::DataLossError(absl::StrCat("the segments between ", number_, " and ",
                                                       number, " are missing")));
      }
      number_ = number;
      PLUMESCOUT_RETURN_IF_ERROR(ReadOne(path, number == paths.rbegin()->first));
    }
    return absl::OkStatus();
  }

  // Not done before all is read: a folder that is refused is left as it is. What stays counts as
  // kept from here on; a process that was killed had not synced the end of it.
  absl::Status Finish() const {
    PLUMESCOUT_RETURN_IF_ERROR(CutTail());
    return segments.empty() ? absl::OkStatus() : SyncPath(segments.back().path);
  }

  LogReplay& replay() { return replay_; }

  std::vector<LogStore::Segment> segments;
  std::vector<absl::Status> damage;

 private:
  absl::Status CutTail() const {
    if (tail_.empty()) return absl::OkStatus();
    std::error_code error;
    if (tail_bytes_ == 0) {
      fs::remove(tail_, error);
    } else {
      fs::resize_file(tail_, tail_bytes_, error);
    }
    if (error) return absl::UnavailableError(absl::StrCat(tail_, ": ", error.message()));
    return absl::OkStatus();
  }

  absl::Status ReadOne(const std::string& path, bool last) {
    const absl::StatusOr<std::string> bytes = ReadFile(path, kMaxSegmentFile_bytes);
    if (!bytes.ok()) {
      damage.push_back(bytes.status());
    } else {
      const SegmentEnd end = replay_.Read(*bytes);
      if (absl::IsFailedPrecondition(end.status)) {
        return absl::FailedPreconditionError(absl::StrCat(path, " ", end.status.message()));
      }
      for (const Renumbering& renumbering : end.renumberings) {
        for (LogStore::Segment& segment : segments) {
          segment.last_sequence = Renumbered(segment.last_sequence, renumbering);
        }
      }
      if (!end.status.ok()) {
        Damaged(path, absl::DataLossError(absl::StrCat(end.status.message(), " at byte ",
                                                       end.damage_bytes, "; ", end.lost_bytes,
                                                       " bytes are left out")));
      }
      // Without a readable head it is cut away whole if it breaks off there, and else left.
      if (last && end.good_bytes < bytes->size() &&
          (end.good_bytes > 0 || absl::IsOutOfRange(end.status))) {
        tail_ = path;
        tail_bytes_ = end.good_bytes;
        if (tail_bytes_ == 0) return absl::OkStatus();
      }
    }
    segments.push_back({path, replay_.log().last_sequence});
    return absl::OkStatus();
  }

  void Damaged(const std::string& path, const absl::Status& what) {
    damage.push_back(absl::Status(what.code(), absl::StrCat(path, ": ", what.message())));
  }

  LogReplay replay_;
  std::int64_t number_ = 0;  // of the segment that was read last
  std::string tail_;         // the last segment, if it does not end well
  std::size_t tail_bytes_ = 0;
};

}  // namespace

LogStore::LogStore(const LogStoreOptions& options, const LogSystem& system, FolderLock lock,
                   SegmentHead head, std::vector<Segment> segments, std::int64_t next_segment)
    : options_(options),
      system_(system),
      lock_(std::move(lock)),
      head_(std::move(head)),
      synced_head_(head_),
      applied_renumberings_(head_.renumberings),
      older_(segments.begin(), segments.end()),
      next_segment_(next_segment) {}

absl::Status LogStore::Append(const Observation& observation) {
  PLUMESCOUT_RETURN_IF_ERROR(Write(observation));
  head_.last_sequence = std::max(head_.last_sequence, LastSequence(observation));
  return absl::OkStatus();
}

absl::Status LogStore::Append(const NumberedRenumbering& numbered) {
  PLUMESCOUT_RETURN_IF_ERROR(Write(numbered));
  if (numbered.number > applied_renumberings_) {
    for (Segment& segment : older_) {
      segment.last_sequence = Renumbered(segment.last_sequence, numbered.renumbering);
    }
    applied_renumberings_ = numbered.number;
  }
  if (numbered.number <= head_.renumberings) return absl::OkStatus();
  head_.renumberings = numbered.number;
  head_.last_sequence = Renumbered(head_.last_sequence, numbered.renumbering);
  head_.applied_sequence = numbered.renumbering.to - 1;
  head_.durable_sequence = 0;
  return absl::OkStatus();
}

absl::Status LogStore::Append(const LogMark& mark) {
  PLUMESCOUT_RETURN_IF_ERROR(Write(mark));
  head_.applied_sequence = mark.applied_sequence;
  head_.durable_sequence = mark.durable_sequence;
  return absl::OkStatus();
}

absl::Status LogStore::Sync() {
  if (current_ == nullptr) return absl::OkStatus();
  const absl::Status synced = current_->Sync();
  if (synced.ok()) {
    synced_head_ = head_;
  } else {
    Abandon();
  }
  return synced;
}

void LogStore::DropBefore(std::int64_t sequence) {
  while (!older_.empty() && older_.front().last_sequence < sequence) {
    std::error_code error;
    fs::remove(older_.front().path, error);
    if (error) return;  // the next time, perhaps
    older_.pop_front();
  }
}

absl::Status LogStore::Write(const LogRecord& record) {
  const std::string bytes = EncodeRecord(record);
  if (current_ != nullptr && current_->size_bytes() + bytes.size() > options_.segment_bytes) {
    PLUMESCOUT_RETURN_IF_ERROR(Sync());
    EndSegment();
  }
  if (current_ == nullptr) PLUMESCOUT_RETURN_IF_ERROR(BeginSegment());
  const absl::Status written = current_->Append(bytes);
  if (current_->broken()) Abandon();
  return written;
}

absl::Status LogStore::BeginSegment() {
  const std::string path = SegmentPath(options_.folder, next_segment_);
  PLUMESCOUT_ASSIGN_OR_RETURN(std::unique_ptr<SegmentFile> file,
                              SegmentFile::Create(path, system_));
  absl::Status begun = file->Append(absl::StrCat(SegmentPreamble(), EncodeRecord(head_)));
  if (begun.ok()) begun = SyncPath(options_.folder);
  if (!begun.ok()) {
    std::error_code ignored;
    fs::remove(path, ignored);
    return begun;
  }
  ++next_segment_;
  current_ = std::move(file);
  return absl::OkStatus();
}

void LogStore::EndSegment() {
  older_.push_back({current_->path(), head_.last_sequence});
  current_.reset();
}

void LogStore::Abandon() {
  ++failed_syncs_;
  EndSegment();
  head_ = synced_head_;
}

absl::StatusOr<OpenedLog> OpenLog(const LogStoreOptions& options, const MissionId& mission,
                                  const RobotId& robot, std::int64_t new_epoch,
                                  const LogSystem& system) {
  PLUMESCOUT_RETURN_IF_ERROR(MakeFolder(options.folder));
  PLUMESCOUT_ASSIGN_OR_RETURN(FolderLock lock, FolderLock::Take(options.folder));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto paths, ListSegments(options.folder));
  SegmentReader reader(mission, robot);
  PLUMESCOUT_RETURN_IF_ERROR(reader.ReadAll(paths));
  PLUMESCOUT_RETURN_IF_ERROR(reader.Finish());
  OpenedLog opened;
  opened.damage = std::move(reader.damage);
  opened.log = reader.replay().TakeLog();
  if (opened.log.epoch == 0) opened.log.epoch = new_epoch;
  const SegmentHead head{.mission = mission,
                         .robot = robot,
                         .epoch = opened.log.epoch,
                         .last_sequence = opened.log.last_sequence,
                         .applied_sequence = opened.log.applied_sequence,
                         .durable_sequence = opened.log.durable_sequence,
                         .renumberings = reader.replay().renumberings()};
  opened.store =
      std::make_unique<LogStore>(options, system, std::move(lock), head, std::move(reader.segments),
                                 paths.empty() ? 1 : paths.rbegin()->first + 1);
  return opened;
}

}  // namespace plumescout::client
