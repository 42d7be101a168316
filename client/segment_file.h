// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout::client {

// The calls of the system by which a log gets to disk, so that tests can have them fail.
struct LogSystem {
  std::function<ssize_t(int, const void*, std::size_t)> write = ::write;
  std::function<int(int)> sync = ::fdatasync;
};

// A file that only grows, by whole pieces. Not thread-safe.
class SegmentFile {
 public:
  // Makes a new file. kUnavailable naming the file.
  static absl::StatusOr<std::unique_ptr<SegmentFile>> Create(const std::string& path,
                                                             const LogSystem& system);
  ~SegmentFile();  // does not sync
  SegmentFile(const SegmentFile&) = delete;
  SegmentFile& operator=(const SegmentFile&) = delete;

  // All of it or nothing: what was written of a piece that does not fit is taken back. kUnavailable
  // naming file and cause. If it cannot be taken back either the file is broken().
  absl::Status Append(absl::string_view piece);
  // What was appended survives the loss of power. After an error nobody knows what does: the file
  // is broken().
  absl::Status Sync();

  const std::string& path() const { return path_; }
  std::size_t size_bytes() const { return size_bytes_; }
  bool broken() const { return broken_; }  // nothing more may be appended

 private:
  SegmentFile(std::string path, int descriptor, const LogSystem& system)
      : path_(std::move(path)), descriptor_(descriptor), system_(system) {}
  absl::Status Failed(int error) const;

  const std::string path_;
  const int descriptor_;
  const LogSystem system_;
  std::size_t size_bytes_ = 0;
  bool broken_ = false;
};

// What the file holds, or which files the folder holds, survives the loss of power. kUnavailable
// naming it.
absl::Status SyncPath(const std::string& path);

}  // namespace plumescout::client
