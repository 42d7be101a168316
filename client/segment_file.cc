// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/segment_file.h"

#include <fcntl.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "absl/strings/str_cat.h"

namespace plumescout::client {
namespace {

constexpr mode_t kSegmentMode = 0644;

}  // namespace

absl::StatusOr<std::unique_ptr<SegmentFile>> SegmentFile::Create(const std::string& path,
                                                                 const LogSystem& system) {
  const int descriptor =
      open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, kSegmentMode);
  if (descriptor < 0) {
    return absl::UnavailableError(absl::StrCat(path, ": ", std::strerror(errno)));
  }
  return std::unique_ptr<SegmentFile>(new SegmentFile(path, descriptor, system));
}

SegmentFile::~SegmentFile() { close(descriptor_); }

absl::Status SegmentFile::Append(absl::string_view piece) {
  std::size_t written_bytes = 0;
  while (written_bytes < piece.size()) {
    const ssize_t step =
        system_.write(descriptor_, piece.data() + written_bytes, piece.size() - written_bytes);
    if (step < 0 && errno == EINTR) continue;
    if (step <= 0) {
      const int error = step < 0 ? errno : ENOSPC;
      broken_ = written_bytes > 0 && ftruncate(descriptor_, static_cast<off_t>(size_bytes_)) != 0;
      return Failed(error);
    }
    written_bytes += static_cast<std::size_t>(step);
  }
  size_bytes_ += piece.size();
  return absl::OkStatus();
}

absl::Status SegmentFile::Sync() {
  if (system_.sync(descriptor_) == 0) return absl::OkStatus();
  broken_ = true;
  return Failed(errno);
}

absl::Status SegmentFile::Failed(int error) const {
  return absl::UnavailableError(absl::StrCat(path_, ": ", std::strerror(error)));
}

absl::Status SyncPath(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (synced) return absl::OkStatus();
  return absl::UnavailableError(absl::StrCat(path, ": ", std::strerror(error)));
}

}  // namespace plumescout::client
