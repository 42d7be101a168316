// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/about/about.h"

#include <cstdlib>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace plumescout::lab {
namespace {

std::string CpuModel() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

std::string LoadOfLastMinute() {
  double load = 0.0;
  return getloadavg(&load, 1) == 1 ? absl::StrFormat("%.2f", load) : "unknown";
}

}  // namespace

std::string CodeVersion() { return PLUMESCOUT_VERSION; }

std::vector<std::pair<std::string, std::string>> AboutThisRun(std::uint64_t seed) {
  return {{"machine", CpuModel()},
          {"load", LoadOfLastMinute()},
          {"build_type", PLUMESCOUT_BUILD_TYPE},
          {"seed", absl::StrCat(seed)},
          {"version", CodeVersion()}};
}

}  // namespace plumescout::lab
