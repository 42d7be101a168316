// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/append_file.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

constexpr int kOwnerWritesOthersRead = 0644;

absl::Status Refused(const std::string& path, int error) {
  const std::string text = absl::StrCat(path, ": ", strerror(error));
  return error == EEXIST ? absl::AlreadyExistsError(text) : absl::UnavailableError(text);
}

}  // namespace

absl::StatusOr<AppendFile> AppendFile::Create(const std::string& path) {
  const int descriptor =
      open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kOwnerWritesOthersRead);
  if (descriptor < 0) return Refused(path, errno);
  return AppendFile(path, descriptor);
}

AppendFile::AppendFile(std::string path, int descriptor)
    : path_(std::move(path)), descriptor_(descriptor) {}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_bytes_(other.size_bytes_) {}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

absl::Status AppendFile::Append(absl::string_view bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = pwrite(descriptor_, bytes.data() + done, bytes.size() - done,
                                 size_bytes_ + static_cast<std::int64_t>(done));
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      const absl::Status refused = Refused(path_, count == 0 ? ENOSPC : errno);
      // If even this fails, what stands there is cut off, as after a crash.
      [[maybe_unused]] const int cut = ftruncate(descriptor_, size_bytes_);
      return refused;
    }
  }
  size_bytes_ += static_cast<std::int64_t>(bytes.size());
  return absl::OkStatus();
}

}  // namespace plumescout
