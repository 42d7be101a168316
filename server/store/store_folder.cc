// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/store_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

constexpr char kDatabaseName[] = "store.db";
constexpr char kHeadMarksName[] = "heads";
constexpr char kLockName[] = "lock";
constexpr mode_t kOwnerOnly = 0700;
constexpr mode_t kOwnersFile = 0600;

absl::Status FolderError(absl::string_view what, const std::string& path, int error) {
  const std::string text = absl::StrCat(what, " ", path, ": ", strerror(error));
  if (error == EACCES || error == EPERM || error == EROFS) return absl::PermissionDeniedError(text);
  return StoreUnavailable(text);
}

absl::Status MakeOwnFolder(const std::string& folder) {
  std::error_code error;
  const std::filesystem::path above = std::filesystem::path(folder).parent_path();
  if (!above.empty()) std::filesystem::create_directories(above, error);
  if (error) return FolderError("cannot make folder", above.string(), error.value());
  if (mkdir(folder.c_str(), kOwnerOnly) == 0) return absl::OkStatus();
  if (errno != EEXIST) return FolderError("cannot make folder", folder, errno);
  if (std::filesystem::is_directory(folder, error)) return absl::OkStatus();
  return FolderError("cannot use folder", folder, ENOTDIR);
}

std::string HostName() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "?";
  return name.data();
}

// What the lock file says of who has the folder.
std::string Holder(int descriptor) {
  std::array<char, 512> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size() - 1, 0);
  const std::string holder =
      size <= 0 ? "" : std::string(text.data(), static_cast<std::size_t>(size));
  return holder.empty() ? "another process" : std::string(absl::StripAsciiWhitespace(holder));
}

void NoteHolder(int descriptor) {
  const std::string holder = absl::StrCat("process ", getpid(), " on ", HostName(), "\n");
  // Only for whoever wants to know; a full disk must not keep a server from reading.
  if (ftruncate(descriptor, 0) != 0) return;
  if (pwrite(descriptor, holder.data(), holder.size(), 0) < 0) return;
}

}  // namespace

std::string DatabaseFile(const std::string& folder) {
  return absl::StrCat(folder, "/", kDatabaseName);
}

std::string HeadMarksFile(const std::string& folder) {
  return absl::StrCat(folder, "/", kHeadMarksName);
}

std::int64_t StoreDiskBytes(const std::string& folder) {
  std::int64_t sum = 0;
  const std::string database = DatabaseFile(folder);
  for (const std::string& path :
       {database, database + "-wal", database + "-shm", HeadMarksFile(folder)}) {
    struct stat entry {};
    if (stat(path.c_str(), &entry) == 0) sum += entry.st_size;
  }
  return sum;
}

bool FileExists(const std::string& path) {
  struct stat entry {};
  return stat(path.c_str(), &entry) == 0;
}

absl::Status SyncFolder(const std::string& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return FolderError("cannot open folder", folder, errno);
  const int error = fsync(descriptor) == 0 ? 0 : errno;
  close(descriptor);
  return error == 0 ? absl::OkStatus() : FolderError("cannot sync folder", folder, error);
}

absl::StatusOr<FolderLock> FolderLock::Take(const std::string& folder) {
  PLUMESCOUT_RETURN_IF_ERROR(MakeOwnFolder(folder));
  const std::string path = absl::StrCat(folder, "/", kLockName);
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kOwnersFile);
  if (descriptor < 0) return FolderError("cannot open", path, errno);
  FolderLock lock(descriptor);
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
    NoteHolder(descriptor);
    return lock;
  }
  if (errno != EWOULDBLOCK) return FolderError("cannot lock", path, errno);
  return absl::FailedPreconditionError(
      absl::StrCat("the store ", folder, " is in use by ", Holder(descriptor)));
}

absl::StatusOr<FolderLock> FolderLock::TakeExisting(const std::string& folder) {
  if (!FileExists(DatabaseFile(folder)) && !FileExists(HeadMarksFile(folder))) {
    return absl::NotFoundError(absl::StrCat("there is no store in ", folder));
  }
  return Take(folder);
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace plumescout::server
