// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <set>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace plumescout {
namespace {

using Names = std::vector<std::string>;

// A folder with those of its subfolders that are no rooms of their own, and what it may include
// besides itself. docs/architecture.md has the same picture.
struct Room {
  std::string folder;
  Names may_include;
};

// Each may include those before it.
const Names kCore = {"core/types",
                     "core/tour",
                     "core/grid",
                     "core/occupancy",
                     "core/linalg",
                     "core/gas/field",
                     "core/gas",
                     "core/frontier",
                     "core/belief",
                     "core/traffic",
                     "core/plan/cost",
                     "core/plan/goals",
                     "core/plan/paths",
                     "core/plan/sampling",
                     "core/plan/selection",
                     "core/plan",
                     "core/plan/team",
                     "core/mission",
                     "core/mission/conduct"};
const Names kServer = {"server/base",  "server/config",  "server/access",   "server/observe",
                       "server/store", "server/maps",    "server/missions", "server/history",
                       "server/calls", "server/streams", "server/services", "server/web",
                       "server"};
const Names kLab = {"lab/about",   "lab/formats", "lab/bags",   "lab/linalg", "lab/rivals",
                    "lab/local",   "lab/sim",     "lab/report", "lab/worlds", "lab/trials",
                    "lab/studies", "lab/bench",   "lab/program"};

Names Before(const Names& rooms, const std::string& folder) {
  return {rooms.begin(), std::find(rooms.begin(), rooms.end(), folder)};
}

Names Join(const std::vector<Names>& parts) {
  Names all;
  for (const Names& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<Room> MakeRooms() {
  const Names adapters = {"proto/convert", "formats",      "formats/journal", "formats/mcap",
                          "formats/draw",  "formats/view", "formats/ros",     "ompl_planners"};
  std::vector<Room> rooms = {
      {"proto/convert", {"core/types", "formats"}},
      {"formats", {"core/types"}},
      {"formats/ros", {}},
      {"formats/journal", {"core/types", "formats"}},
      {"formats/mcap", {"core/types", "formats", "formats/journal"}},
      {"formats/draw",
       {"core/types", "proto/convert", "formats", "formats/journal", "formats/mcap"}},
      {"formats/view",
       Join({Before(kCore, "core/mission/conduct"),
             {"proto/convert", "formats", "formats/journal", "formats/mcap", "formats/draw"}})},
      {"ompl_planners", Before(kCore, "core/mission")},
      {"client", {"core/types", "proto/convert", "formats", "formats/mcap", "formats/draw"}},
      {"client/ros2", {"core/types", "formats", "formats/ros", "client"}},
      {"tests", Join({kCore, adapters, kServer, {"client", "client/ros2"}, kLab})},
  };
  for (const std::string& folder : kCore) rooms.push_back({folder, Before(kCore, folder)});
  for (const std::string& folder : kServer) {
    rooms.push_back({folder, Join({kCore, adapters, Before(kServer, folder)})});
  }
  const std::vector<Room> narrow = {
      {"lab/formats", {"core/types", "formats"}},
      {"lab/bags",
       {"core/types", "formats", "formats/mcap", "formats/ros", "client", "client/ros2"}},
      {"lab/local", Join({kCore, {"client"}})},
      {"lab/linalg", {"core/types", "core/linalg"}},
      {"lab/sim",
       {"core/types", "core/grid", "core/linalg", "formats", "client", "lab/formats",
        "lab/linalg"}},
      {"lab/report", {"core/types", "formats", "lab/formats"}},
      // Servers are measured as programs, but for what keeps missions.
      {"lab/bench", Join({kCore, adapters, {"client", "server/store"}, Before(kLab, "lab/bench")})},
  };
  for (const std::string& folder : kLab) {
    const auto room = std::find_if(narrow.begin(), narrow.end(),
                                   [&](const Room& narrower) { return narrower.folder == folder; });
    rooms.push_back(room != narrow.end()
                        ? *room
                        : Room{folder, Join({kCore, adapters, {"client"}, Before(kLab, folder)})});
  }
  return rooms;
}

const std::vector<Room>& Rooms() {
  static const std::vector<Room> rooms = MakeRooms();
  return rooms;
}

bool IsBelow(const std::string& path, const std::string& folder) {
  return absl::StartsWith(path, folder + "/");
}

// The smallest room around the file.
const Room* FindRoom(const std::string& path) {
  const Room* found = nullptr;
  for (const Room& room : Rooms()) {
    if (!IsBelow(path, room.folder)) continue;
    if (found == nullptr || room.folder.size() > found->folder.size()) found = &room;
  }
  return found;
}

// Whether a file of the room may include the other's.
bool MayInclude(const Room& room, const Room* other) {
  if (other == nullptr) return false;
  return other == &room ||
         std::count(room.may_include.begin(), room.may_include.end(), other->folder) > 0;
}

// Whether the include is somebody else's: a library's, or generated from proto/.
bool IsForeign(const std::string& include) {
  for (const char* prefix :
       {"absl/", "google/", "foxglove/", "plumescout/", "gtest/", "gmock/", "CLI/"}) {
    if (absl::StartsWith(include, prefix)) return true;
  }
  return false;
}

using Graph = std::map<std::string, std::set<std::string>>;

// A way round in the graph, "a -> b -> a", or nothing. Depth-first, each node once.
std::optional<std::string> FindCycle(const Graph& graph) {
  Names way;
  std::set<std::string> done;
  const std::function<bool(const std::string&)> visit = [&](const std::string& node) {
    const bool met = std::find(way.begin(), way.end(), node) != way.end();
    way.push_back(node);
    if (met) return true;
    if (done.insert(node).second && graph.count(node) > 0) {
      for (const std::string& next : graph.at(node)) {
        if (visit(next)) return true;
      }
    }
    way.pop_back();
    return false;
  };
  for (const auto& [node, next] : graph) {
    if (!visit(node)) continue;
    const auto first = std::find(way.begin(), way.end(), way.back());
    return absl::StrJoin(first, way.end(), " -> ");
  }
  return std::nullopt;
}

bool IsGrpc(const std::string& include) {
  return absl::StartsWith(include, "grpc") || absl::EndsWith(include, ".grpc.pb.h");
}

bool IsProtobuf(const std::string& include) {
  return absl::StartsWith(include, "google/") || absl::EndsWith(include, ".pb.h");
}

// What core must not include: threads, files, clocks, global random numbers, the console.
bool IsImpure(const std::string& include) {
  static const std::set<std::string> names = {
      "thread",  "mutex",  "shared_mutex", "condition_variable", "future",     "atomic",
      "fstream", "cstdio", "iostream",     "filesystem",         "chrono",     "ctime",
      "random",  "time.h", "stdio.h",      "unistd.h",           "sys/time.h", "pthread.h"};
  const bool from_absl = absl::StartsWith(include, "absl/time/") ||
                         absl::StartsWith(include, "absl/synchronization/") ||
                         absl::StartsWith(include, "absl/random/");
  return from_absl || names.count(include) > 0;
}

bool IsCholmod(const std::string& include) {
  return absl::EndsWith(include, "cholmod.h") || include == "Eigen/CholmodSupport";
}

bool IsGlpk(const std::string& include) { return include == "glpk.h"; }

// A library that one source of one folder includes, and nobody else in core.
struct SoleUse {
  const char* library;
  bool (*is_header)(const std::string& include);
  const char* folder;
};
constexpr const char* kLinalg = "core/linalg";
constexpr SoleUse kSoleUses[] = {{"CHOLMOD", IsCholmod, kLinalg}, {"GLPK", IsGlpk, "core/tour"}};

// Why `file` must not include it; empty if it may.
std::string WhyForbidden(const SourceFile& file, const std::string& include) {
  const bool in_core = IsBelow(file.path, "core");
  if (in_core && (IsGrpc(include) || IsProtobuf(include))) return "core knows no wire";
  if (in_core && IsImpure(include)) return "core is pure";
  if (IsBelow(file.path, "proto/convert") && IsGrpc(include)) return "conversion knows no gRPC";
  for (const SoleUse& use : kSoleUses) {
    // The laboratory orders matrices by CHOLMOD, and benches measure such a library as a rival.
    const bool may_use = IsBelow(file.path, use.folder) || IsBelow(file.path, "lab/bench") ||
                         (use.folder == kLinalg && IsBelow(file.path, "lab/linalg"));
    if (use.is_header(include) && (!may_use || file.is_header())) {
      return absl::StrCat(use.library, " has one user");
    }
  }
  const bool may_ompl = IsBelow(file.path, "ompl_planners") && !file.is_header();
  if (absl::StartsWith(include, "ompl/") && !may_ompl) {
    return "OMPL stays in the sources of ompl_planners";
  }
  const bool may_store =
      (IsBelow(file.path, "server/store") || IsBelow(file.path, "tests")) && !file.is_header();
  const bool may_sqlite = may_store || (IsBelow(file.path, "lab/bags") && !file.is_header());
  if (include == "sqlite3.h" && !may_sqlite) {
    return "SQLite stays in the sources of server/store and lab/bags";
  }
  if (include == "libpq-fe.h" && !may_store) return "libpq stays in the sources of server/store";
  const bool may_wire = IsBelow(file.path, "server") || IsBelow(file.path, "client") ||
                        IsBelow(file.path, "proto/convert") || IsBelow(file.path, "tests");
  if (file.is_header() && (IsGrpc(include) || IsProtobuf(include)) && !may_wire) {
    return "headers without the wire";
  }
  return "";
}

Names AllIncludes(const SourceFile& file) {
  return Join({file.quoted_includes, file.system_includes});
}

// Sources of core that include the library.
Names CoreUsers(const std::vector<SourceFile>& files, const SoleUse& use) {
  Names users;
  for (const SourceFile& file : files) {
    const Names includes = AllIncludes(file);
    const bool uses = std::any_of(includes.begin(), includes.end(), use.is_header);
    if (uses && IsBelow(file.path, "core")) users.push_back(file.path);
  }
  return users;
}

}  // namespace

std::vector<std::string> CheckDirections(const std::vector<SourceFile>& files) {
  std::set<std::string> known;
  for (const SourceFile& file : files) known.insert(file.path);
  Names violations;
  for (const SourceFile& file : files) {
    const Room* const room = FindRoom(file.path);
    if (room == nullptr) {
      violations.push_back(absl::StrCat(file.path, " lies in no folder of the table"));
      continue;
    }
    for (const std::string& include : file.quoted_includes) {
      if (IsForeign(include)) continue;
      if (known.count(include) == 0) {
        violations.push_back(absl::StrCat(file.path, " includes ", include, ", which is no file"));
        continue;
      }
      const bool allowed = MayInclude(*room, FindRoom(include));
      if (!allowed) violations.push_back(absl::StrCat(file.path, " must not include ", include));
    }
  }
  return violations;
}

std::vector<std::string> CheckCycles(const std::vector<SourceFile>& files) {
  Graph file_graph;
  Graph folder_graph;
  for (const SourceFile& file : files) {
    for (const std::string& include : file.quoted_includes) {
      if (IsForeign(include)) continue;
      file_graph[file.path].insert(include);
      const std::string folder = FolderOf(include);
      if (folder != file.folder()) folder_graph[file.folder()].insert(folder);
    }
  }
  Names violations;
  for (const Graph& graph : {file_graph, folder_graph}) {
    if (const std::optional<std::string> cycle = FindCycle(graph)) violations.push_back(*cycle);
  }
  return violations;
}

std::vector<std::string> CheckPlatformHeaders(const std::vector<SourceFile>& files) {
  Names violations;
  for (const SourceFile& file : files) {
    for (const std::string& include : AllIncludes(file)) {
      const std::string why = WhyForbidden(file, include);
      if (!why.empty()) {
        violations.push_back(absl::StrCat(file.path, " must not include ", include, ": ", why));
      }
    }
  }
  for (const SoleUse& use : kSoleUses) {
    const Names users = CoreUsers(files, use);
    if (users.size() < 2) continue;
    violations.push_back(
        absl::StrCat("several users of ", use.library, ": ", absl::StrJoin(users, ", ")));
  }
  return violations;
}

std::vector<std::string> CheckImpureCalls(const std::vector<SourceFile>& files) {
  static const std::regex kCalls(
      R"(\b(std::cout|std::cerr|printf|random_device|srand|rand|getenv|clock_gettime|time)\b\s*(\(|<<))");
  Names violations;
  for (const SourceFile& file : files) {
    std::smatch match;
    if (IsBelow(file.path, "core") && std::regex_search(file.code, match, kCalls)) {
      violations.push_back(absl::StrCat(file.path, " calls ", match[1].str()));
    }
  }
  return violations;
}

}  // namespace plumescout
