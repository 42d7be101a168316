// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/header_rules.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"

namespace plumescout {
namespace {

struct Declared {
  const char* include;
  const char* names;
};
constexpr Declared kStandard[] = {
    {"algorithm",
     "sort min max clamp find_if any_of all_of none_of count count_if max_element "
     "min_element lower_bound upper_bound fill fill_n copy copy_n reverse transform"},
    {"array", "array"},
    {"atomic", "atomic"},
    {"bit", "bit_ceil bit_width endian"},
    {"chrono", "chrono"},
    {"cmath", "sqrt hypot isfinite isnan floor ceil exp log pow sin cos lround llround nan"},
    {"condition_variable", "condition_variable"},
    {"cstddef", "size_t ptrdiff_t byte nullptr_t"},
    {"cstdint", "int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t intptr_t"},
    {"cstring", "memcpy memcmp memset"},
    {"deque", "deque"},
    {"filesystem", "filesystem"},
    {"fstream", "ifstream ofstream fstream"},
    {"functional", "function"},
    {"future", "future promise"},
    {"initializer_list", "initializer_list"},
    {"limits", "numeric_limits"},
    {"list", "list"},
    {"map", "map multimap"},
    {"memory", "unique_ptr shared_ptr weak_ptr make_unique make_shared enable_shared_from_this"},
    {"mutex", "mutex lock_guard unique_lock"},
    {"optional", "optional nullopt"},
    {"ostream", "ostream"},
    {"queue", "queue priority_queue"},
    {"set", "set multiset"},
    {"span", "span"},
    {"sstream", "ostringstream istringstream stringstream"},
    {"string", "string to_string"},
    {"thread", "thread this_thread"},
    {"tuple", "tuple tie"},
    {"unordered_map", "unordered_map"},
    {"unordered_set", "unordered_set"},
    {"utility", "pair move exchange forward swap as_const declval"},
    {"variant", "variant monostate visit get_if holds_alternative"},
    {"vector", "vector"},
};
constexpr Declared kAbseil[] = {
    {"absl/base/call_once.h", "once_flag"},
    {"absl/status/status.h",
     "Status StatusCode OkStatus InvalidArgumentError UnavailableError "
     "CancelledError IsInvalidArgument IsNotFound"},
    {"absl/status/statusor.h", "StatusOr"},
    {"absl/strings/match.h", "StrContains StartsWith EndsWith"},
    {"absl/strings/str_cat.h", "StrCat StrAppend"},
    {"absl/strings/str_format.h", "StrFormat"},
    {"absl/strings/string_view.h", "string_view"},
    {"absl/synchronization/mutex.h", "Mutex MutexLock Condition"},
    {"absl/synchronization/notification.h", "Notification"},
    {"absl/time/clock.h", "Now SleepFor"},
    {"absl/time/time.h",
     "Duration Time Milliseconds Seconds Minutes InfiniteDuration "
     "ZeroDuration InfiniteFuture ToInt64Nanoseconds"},
    {"absl/types/span.h", "Span"},
};

using Names = std::vector<std::string>;
// By name, as "std::vector", what declares it.
using Table = std::map<std::string, std::string, std::less<>>;

template <std::size_t kSize>
void AddTo(Table& table, absl::string_view space, const Declared (&rows)[kSize]) {
  for (const Declared& row : rows) {
    for (const absl::string_view name : absl::StrSplit(row.names, ' ')) {
      table[absl::StrCat(space, name)] = row.include;
    }
  }
}

Table MakeTable() {
  Table table;
  AddTo(table, "std::", kStandard);
  AddTo(table, "absl::", kAbseil);
  return table;
}

// What the code uses of a namespace, as "std::vector".
void FindNames(const std::string& code, const std::string& space, std::set<std::string>& names) {
  const auto is_part = [](char c) { return absl::ascii_isalnum(c) != 0 || c == '_'; };
  for (std::size_t at = code.find(space); at != std::string::npos; at = code.find(space, at + 1)) {
    if (at > 0 && is_part(code[at - 1])) continue;
    std::size_t end = at + space.size();
    while (end < code.size() && is_part(code[end])) ++end;
    names.insert(code.substr(at, end - at));
  }
}

// All that a header includes, and what headers of ours among that include.
class Reach {
 public:
  explicit Reach(const std::vector<SourceFile>& files) {
    for (const SourceFile& file : files) files_[file.path] = &file;
  }

  const std::set<std::string>& Of(const std::string& path) {
    const auto [entry, is_new] = known_.try_emplace(path);
    const auto file = files_.find(path);
    if (!is_new || file == files_.end()) return entry->second;
    std::set<std::string> reach(file->second->system_includes.begin(),
                                file->second->system_includes.end());
    for (const std::string& include : file->second->quoted_includes) {
      const std::set<std::string>& more = Of(include);
      reach.insert(include);
      reach.insert(more.begin(), more.end());
    }
    return known_[path] = std::move(reach);
  }
  bool Has(const std::string& path) const { return files_.count(path) > 0; }

 private:
  std::map<std::string, const SourceFile*> files_;
  std::map<std::string, std::set<std::string>> known_;
};

}  // namespace

std::vector<std::string> CheckHeaders(const std::vector<SourceFile>& files) {
  static const Table table = MakeTable();
  Reach reach(files);
  Names violations;
  for (const SourceFile& file : files) {
    if (!file.is_header()) {
      const std::string own = absl::StrCat(file.path.substr(0, file.path.size() - 2), "h");
      const std::string first = absl::StrCat("#include \"", own, "\"");
      const absl::string_view text = file.text;
      const std::size_t at = std::min(text.size(), text.find("#include"));
      if (reach.Has(own) && !absl::StartsWith(text.substr(at), first)) {
        violations.push_back(absl::StrCat(file.path, " does not include its header first"));
      }
      continue;
    }
    std::set<std::string> names;
    FindNames(file.code, "std::", names);
    FindNames(file.code, "absl::", names);
    for (const std::string& name : names) {
      const auto declared = table.find(name);
      if (declared == table.end() || reach.Of(file.path).count(declared->second) > 0) continue;
      violations.push_back(
          absl::StrCat(file.path, " uses ", name, " and does not include ", declared->second));
    }
  }
  return violations;
}

}  // namespace plumescout
