// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/data_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "absl/cleanup/cleanup.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "core/types/quantile.h"

namespace plumescout::lab {

DataFolder::DataFolder()
    : path_((std::filesystem::temp_directory_path() / "plumescout-load-XXXXXX").string()) {
  if (mkdtemp(path_.data()) == nullptr) std::abort();  // nothing can be measured
}

DataFolder::~DataFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> DataFolder::Settings() const {
  return {"store.engine=sqlite", absl::StrCat("store.folder=", path_)};
}

absl::StatusOr<absl::Duration> DataFolder::SyncTime() const {
  constexpr int kWrites = 50;
  const std::string path = absl::StrCat(path_, "/sync");
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) return absl::ErrnoToStatus(errno, path);
  const absl::Cleanup remove = [&] {
    close(file);
    unlink(path.c_str());
  };
  const std::array<char, 4096> page{};
  std::vector<double> times_ms;
  for (int i = 0; i < kWrites; ++i) {
    const absl::Time began = absl::Now();
    if (write(file, page.data(), page.size()) != static_cast<ssize_t>(page.size()) ||
        fdatasync(file) != 0) {
      return absl::ErrnoToStatus(errno, path);
    }
    times_ms.push_back(absl::ToDoubleMilliseconds(absl::Now() - began));
  }
  return absl::Milliseconds(1) * Quantile(times_ms, 0.5);
}

}  // namespace plumescout::lab
