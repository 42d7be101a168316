// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "absl/strings/str_cat.h"

namespace plumescout::client {
namespace {

constexpr std::size_t kLongestPid = 20;  // digits

std::string Holder(int descriptor) {
  char digits[kLongestPid];
  const ssize_t size = pread(descriptor, digits, sizeof(digits), 0);
  return size > 0 ? absl::StrCat("process ", std::string(digits, static_cast<std::size_t>(size)))
                  : "another process";
}

}  // namespace

absl::StatusOr<FolderLock> FolderLock::Take(const std::string& folder) {
  const std::string path = absl::StrCat(folder, "/lock");
  FolderLock lock(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (lock.descriptor_ < 0) {
    return absl::UnavailableError(absl::StrCat(path, ": ", std::strerror(errno)));
  }
  if (flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) {
      return absl::UnavailableError(absl::StrCat(path, ": ", std::strerror(errno)));
    }
    return absl::FailedPreconditionError(
        absl::StrCat(folder, ": is in use by ", Holder(lock.descriptor_)));
  }
  // For people: nothing depends on it, a full disk included.
  const std::string pid = absl::StrCat(getpid());
  [[maybe_unused]] const bool named = ftruncate(lock.descriptor_, 0) == 0 &&
                                      pwrite(lock.descriptor_, pid.data(), pid.size(), 0) > 0;
  return lock;
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace plumescout::client
