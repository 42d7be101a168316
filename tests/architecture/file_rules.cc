// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/file_rules.h"

#include <regex>
#include <set>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

constexpr char kLicence[] =
    "// SPDX-FileCopyrightText: PlumeScout contributors\n"
    "// SPDX-License-Identifier: Apache-2.0\n";

// A source whose behaviour only shows within another one's test.
struct StandIn {
  const char* source;
  const char* test;
};
constexpr StandIn kStandIns[] = {
    {"ompl_planners/ompl_space.cc", "tests/ompl_planners/ompl_search_test.cc"},
};

// Programs and what only they are made of are tried as a whole: by end-to-end tests, or by being
// measured.
bool IsProgram(const std::string& path) {
  for (const char* folder : {"client/examples/", "lab/bench/", "lab/program/", "tests/"}) {
    if (absl::StartsWith(path, folder)) return true;
  }
  return absl::EndsWith(path, "/main.cc") || absl::EndsWith(path, "_main.cc");
}

}  // namespace

std::vector<std::string> CheckMirror(const std::vector<SourceFile>& files) {
  std::set<std::string> paths;
  for (const SourceFile& file : files) paths.insert(file.path);
  std::set<std::string> untested;
  for (const std::string& path : paths) {
    if (!absl::EndsWith(path, ".cc") || IsProgram(path)) continue;
    const std::string stem = absl::StrCat("tests/", path.substr(0, path.size() - 3));
    const bool tested = paths.count(stem + "_test.cc") + paths.count(stem + "_slow_test.cc") > 0;
    if (!tested) untested.insert(path);
  }
  std::vector<std::string> violations;
  for (const StandIn& stand_in : kStandIns) {
    if (paths.count(stand_in.source) == 0) continue;
    if (untested.erase(stand_in.source) == 0) {
      violations.push_back(absl::StrCat(stand_in.source, " has a test: strike it off the list"));
    } else if (paths.count(stand_in.test) == 0) {
      violations.push_back(
          absl::StrCat(stand_in.test, " is to test ", stand_in.source, " but does not exist"));
    }
  }
  for (const std::string& path : untested) {
    violations.push_back(absl::StrCat(path, " has no test of its name"));
  }
  return violations;
}

std::vector<std::string> CheckFrames(const std::vector<SourceFile>& files) {
  static const std::regex kUsing(R"(\busing\s+namespace\b)");
  std::vector<std::string> violations;
  for (const SourceFile& file : files) {
    if (!absl::StartsWith(file.text, kLicence)) {
      violations.push_back(absl::StrCat(file.path, " does not begin with the licence"));
    }
    if (!file.is_header()) continue;
    if (!absl::StrContains(file.code, "\n#pragma once\n")) {
      violations.push_back(absl::StrCat(file.path, " lacks #pragma once"));
    }
    if (std::regex_search(file.code, kUsing)) {
      violations.push_back(absl::StrCat(file.path, " has a using directive"));
    }
  }
  return violations;
}

}  // namespace plumescout
