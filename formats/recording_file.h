// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"

namespace plumescout {

// Appends to a file: all of a piece or none of it.
using AppendBytes = std::function<absl::Status(absl::string_view)>;
// Makes a file and the folders above it; kAlreadyExists if it is there.
using OpenRecording = std::function<absl::StatusOr<AppendBytes>(const std::string& path)>;

absl::StatusOr<AppendBytes> OpenRecordingFile(const std::string& path);

struct RecordingFileOptions {
  // What came so long ago can be read whatever becomes of the program.
  absl::Duration chunk_period = absl::Seconds(10);
  std::int64_t max_file_bytes = std::int64_t{1} << 30;
  absl::Duration retry_after = absl::Seconds(30);  // a file that could not be written
  OpenRecording open = OpenRecordingFile;
};

// Where an MCAP file goes that is written while what it tells of happens, and the files that follow
// it: there is another one once a file is long enough, or could not be written. Whoever writes has
// the bytes, and is told when to end a chunk or a file. Single-threaded; blocks as the disk does.
class RecordingFile {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit RecordingFile(RecordingFileOptions options) : options_(std::move(options)) {}

  // Whether no other is to be begun yet, after one that could not be written.
  bool rests(Time now) const { return now < retry_at_; }
  // STEM.mcap, or if that is there STEM-2.mcap, and so on: none is overwritten. Errors name the
  // file.
  absl::Status Begin(const std::string& stem);
  // What there is of whole chunks, or nothing. Errors as of AppendFile.
  absl::Status Append(absl::string_view bytes);
  // Something was added that stands in no whole chunk yet.
  void NoteMessage(Time now);
  bool IsChunkDue(Time now) const { return now >= chunk_end_; }
  // Nothing waits for its chunk any more.
  void NoteChunk() { chunk_end_ = Time::max(); }
  bool is_full() const { return file_bytes_ >= options_.max_file_bytes; }
  // The file is whole; or it could not be written, and stays as it is.
  void End();
  void GiveUp(Time now);

  const std::string& path() const { return path_; }  // of the last one that was begun
  absl::Duration retry_after() const { return options_.retry_after; }

 private:
  const RecordingFileOptions options_;
  std::string path_;
  AppendBytes append_;
  std::int64_t file_bytes_ = 0;
  Time chunk_end_ = Time::max();
  Time retry_at_ = Time::min();
};

}  // namespace plumescout
