// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What tests of logs on disk have in common.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "client/log_store.h"
#include "core/types/observation.h"

namespace plumescout::client {

// The number is told by time and pose too, so that a mix-up shows.
inline Observation EntryAt(std::int64_t number) {
  return {.sequence = number,
          .sample_time_ns = 1000 + number,
          .pose = {.x_m = static_cast<double>(number)},
          .payload = GasReading{.concentration_ppm = static_cast<double>(number)}};
}

inline std::vector<std::int64_t> NumbersOf(const std::vector<Observation>& entries) {
  std::vector<std::int64_t> numbers;
  for (const Observation& entry : entries) numbers.push_back(entry.sequence);
  return numbers;
}

// The segments of a folder, by age.
inline std::vector<std::string> SegmentsIn(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().filename().string().rfind("log-", 0) == 0) paths.push_back(file.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

// A disk that fails when a test says so.
struct FailingDisk {
  bool full = false;
  bool syncs = true;
  int half_writes = 0;  // so many writes still go half way
  int sync_count = 0;

  LogSystem System() {
    return {.write = [this](int descriptor, const void* bytes, std::size_t size) -> ssize_t {
              if (!full) return ::write(descriptor, bytes, size);
              if (half_writes-- > 0) return ::write(descriptor, bytes, size / 2);
              errno = ENOSPC;
              return -1;
            },
            .sync =
                [this](int) {
                  ++sync_count;
                  errno = EIO;
                  return syncs ? 0 : -1;
                }};
  }
};

}  // namespace plumescout::client
