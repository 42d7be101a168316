// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/process_memory.h"

#include <malloc.h>

#include <fstream>
#include <limits>
#include <string>

namespace plumescout::lab {
namespace {

double ProcessMemory_mb(const std::string& key) {
  constexpr double kMegabytesPerKibibyte = 1024e-6;
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) == 0) {
      return std::stod(line.substr(key.size())) * kMegabytesPerKibibyte;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double PeakMemory_mb() { return ProcessMemory_mb("VmHWM:"); }

double ResetPeak_mb() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
  return ProcessMemory_mb("VmRSS:");
}

}  // namespace plumescout::lab
