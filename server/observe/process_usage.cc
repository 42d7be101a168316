// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/observe/process_usage.h"

#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace plumescout::server {
namespace {

std::int64_t ResidentBytes() {
  std::ifstream file("/proc/self/statm");  // pages: all, then resident
  std::int64_t all = 0;
  std::int64_t resident = 0;
  if (!(file >> all >> resident)) return 0;
  return resident * sysconf(_SC_PAGESIZE);
}

int CountEntries(const char* folder) {
  std::error_code error;
  const std::filesystem::directory_iterator entries(folder, error);
  if (error) return 0;
  return static_cast<int>(std::distance(begin(entries), end(entries)));
}

std::int64_t MaxFds() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return 0;
  return static_cast<std::int64_t>(limit.rlim_cur);
}

double Seconds(const timeval& time) {
  constexpr double kMicrosecond_s = 1e-6;
  return static_cast<double>(time.tv_sec) + kMicrosecond_s * static_cast<double>(time.tv_usec);
}

double Cpu_s() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0.0;
  return Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
}

}  // namespace

ProcessUsage ReadProcessUsage() {
  return {ResidentBytes(), CountEntries("/proc/self/fd") - 1,  // one is of the counting
          MaxFds(), Cpu_s(), CountEntries("/proc/self/task")};
}

}  // namespace plumescout::server
