// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/reach_rules.h"

#include <map>
#include <set>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

using Names = std::vector<std::string>;

// Programs, examples, and the headers that the client library is published by.
bool IsRoot(const SourceFile& file) {
  if (absl::StartsWith(file.path, "client/examples/")) return true;
  for (const char* program :
       {"server/main.cc", "client/robot_main.cc", "client/ros2/ros2_main.cc"}) {
    if (file.path == program) return true;
  }
  return file.folder() == "client" && file.is_header();
}

bool IsProduct(const std::string& path) {
  return !absl::StartsWith(path, "lab/") && !absl::StartsWith(path, "tests/");
}

// For every file the files that it needs.
std::map<std::string, Names> MakeNeeds(const std::vector<SourceFile>& files) {
  std::set<std::string> paths;
  for (const SourceFile& file : files) paths.insert(file.path);
  std::map<std::string, Names> needs;
  for (const SourceFile& file : files) {
    Names& own_needs = needs[file.path];
    own_needs.insert(own_needs.end(), file.quoted_includes.begin(), file.quoted_includes.end());
    if (file.is_header()) continue;
    const std::string own = absl::StrCat(file.path.substr(0, file.path.size() - 2), "h");
    if (paths.count(own) > 0) {
      needs[own].push_back(file.path);
    } else if (!file.quoted_includes.empty()) {
      needs[file.quoted_includes.front()].push_back(file.path);
    }
  }
  return needs;
}

}  // namespace

std::vector<std::string> CheckReachability(const std::vector<SourceFile>& files) {
  const std::map<std::string, Names> needs = MakeNeeds(files);
  std::set<std::string> reached;
  Names ahead;
  for (const SourceFile& file : files) {
    if (IsRoot(file)) ahead.push_back(file.path);
  }
  while (!ahead.empty()) {
    const std::string path = ahead.back();
    ahead.pop_back();
    if (!reached.insert(path).second) continue;
    const auto next = needs.find(path);
    if (next != needs.end()) ahead.insert(ahead.end(), next->second.begin(), next->second.end());
  }
  Names violations;
  for (const SourceFile& file : files) {
    if (!IsProduct(file.path) || reached.count(file.path) > 0) continue;
    violations.push_back(absl::StrCat(file.path, " is needed by the laboratory only"));
  }
  return violations;
}

}  // namespace plumescout
