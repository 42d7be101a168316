// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/reach_rules.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

using Names = std::vector<std::string>;

// Programs, examples, and the headers that the client library is published by.
bool IsRoot(const SourceFile& file, const Names& published) {
  if (absl::StartsWith(file.path, "client/examples/")) return true;
  for (const char* program :
       {"server/main.cc", "client/robot_main.cc", "client/ros2/ros2_main.cc"}) {
    if (file.path == program) return true;
  }
  return std::count(published.begin(), published.end(), file.path) > 0;
}

bool IsProduct(const std::string& path) {
  return !absl::StartsWith(path, "lab/") && !absl::StartsWith(path, "tests/");
}

// The header whose declarations a source defines: the one of its name, else the first of its own
// folder that it includes; empty if there is neither.
std::string HeaderOf(const SourceFile& source, const std::set<std::string>& paths) {
  const std::string own = absl::StrCat(source.path.substr(0, source.path.size() - 2), "h");
  if (paths.count(own) > 0) return own;
  for (const std::string& include : source.quoted_includes) {
    if (paths.count(include) > 0 && FolderOf(include) == source.folder()) return include;
  }
  return "";
}

// For every file the files that it needs.
std::map<std::string, Names> MakeNeeds(const std::vector<SourceFile>& files) {
  std::set<std::string> paths;
  for (const SourceFile& file : files) paths.insert(file.path);
  std::map<std::string, Names> needs;
  for (const SourceFile& file : files) {
    Names& own_needs = needs[file.path];
    own_needs.insert(own_needs.end(), file.quoted_includes.begin(), file.quoted_includes.end());
    if (!file.is_header()) needs[HeaderOf(file, paths)].push_back(file.path);
  }
  return needs;
}

}  // namespace

std::vector<std::string> PublishedHeaders(const std::string& folder,
                                          const std::string& cmake_lists) {
  std::istringstream words(
      cmake_lists.substr(std::min(cmake_lists.size(), cmake_lists.find("plumescout_publish("))));
  Names headers;
  for (std::string word; words >> word;) {
    const bool is_last = absl::EndsWith(word, ")");
    if (is_last) word.pop_back();
    if (absl::EndsWith(word, ".h")) headers.push_back(absl::StrCat(folder, "/", word));
    if (is_last) break;
  }
  return headers;
}

std::vector<std::string> CheckReachability(const std::vector<SourceFile>& files,
                                           const std::vector<std::string>& published) {
  const std::map<std::string, Names> needs = MakeNeeds(files);
  std::set<std::string> reached;
  Names ahead;
  for (const SourceFile& file : files) {
    if (IsRoot(file, published)) ahead.push_back(file.path);
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
