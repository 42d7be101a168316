// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/spool_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"

namespace plumescout::server {

absl::StatusOr<SpoolFile> SpoolFile::Create(const std::string& folder) {
  std::error_code error;
  std::string name = folder.empty() ? std::filesystem::temp_directory_path(error).string() : folder;
  if (error) return absl::UnavailableError(absl::StrCat("no temporary folder: ", error.message()));
  // Not O_TMPFILE, which some file systems lack.
  name += "/plumescout-import-XXXXXX";
  const int descriptor = mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) {
    return absl::UnavailableError(absl::StrCat(name, ": ", std::strerror(errno)));
  }
  unlink(name.c_str());
  return SpoolFile(descriptor);
}

SpoolFile::~SpoolFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

SpoolFile::SpoolFile(SpoolFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

absl::Status SpoolFile::Append(absl::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      return absl::UnavailableError(
          absl::StrCat("the file has no room on this server: ", std::strerror(errno)));
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return absl::OkStatus();
}

std::string SpoolFile::path() const { return absl::StrCat("/proc/self/fd/", descriptor_); }

}  // namespace plumescout::server
