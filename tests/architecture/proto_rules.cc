// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/proto_rules.h"

#include <regex>
#include <set>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "tests/architecture/source_tree.h"

namespace plumescout {
namespace {

// Units, and words that say what is counted or compared.
constexpr const char* kSuffixes[] = {
    "_m",        "_m2",          "_rad",      "_s",        "_ns",     "_mps",
    "_mps2",     "_hz",          "_ppm",      "_ppm2",     "_per_m",  "_ratio",
    "_per_ppm2", "_probability", "_nats",     "_log_odds", "_share",  "_percentile",
    "_factor",   "_count",       "_sequence", "_revision", "_column", "_row",
    "_columns",  "_rows",        "_index",    "_bytes",    "_epochs"};

// Numbers that have no unit.
const std::set<std::string>& PureNumbers() {
  static const std::set<std::string> names = {
      "beta",                    // weight, [XIT] Eq. (8)
      "column",                  // of a cell
      "confidence",              // a probability
      "crc32",                   // a checksum
      "cost",                    // J, [XIT] Eq. (13): its unit follows from the strategy
      "fallback_limit",          // a count
      "information_penalty",     // [XIT] Eq. (12), of a path
      "lease_token",             // opaque
      "log_epoch",               // opaque
      "level_of_detail",         // n: squares of 2^n cells
      "max_batch_observations",  // counts, as the others of the server's configuration
      "max_missions",
      "max_missions_per_tenant",
      "max_queued",
      "max_queued_observations",
      "max_queued_per_mission",
      "max_queued_per_robot",
      "max_queued_queries",
      "max_running_per_mission",
      "max_streams_per_connection",
      "max_waiting_calls",
      "max_watchers_per_robot",
      "mean_ucb",          // in [0, 1], [MIT] Eq. (3)
      "noise_log_stddev",  // of a logarithm
      "number",            // of an event
      "first_number",
      "page_size",                   // a count
      "prior_precision_log_stddev",  // of a logarithm
      "query_threads",
      "recovery_threads",
      "revision",       // of a mission
      "reward",         // of sampling sites: its unit follows from which reward it is
      "row",            // of a cell
      "seed",           // opaque
      "sequence",       // of an observation
      "survey_stride",  // in sites
      "stream_window_observations",
      "sweep_leg_stride",  // in rows of sites
      "sweep_stride",      // in sites
      "threads",
      "value_offset",  // in the unit of the raster's layer
      "value_scale",   // in the unit of the raster's layer
  };
  return names;
}

}  // namespace

std::vector<std::string> CheckUnits(const std::string& path, const std::string& text) {
  static const std::regex kField(
      R"(\b(?:double|float|s?u?int(?:32|64)|s?fixed(?:32|64))\s+([a-z][a-z0-9_]*)\s*=)");
  const std::string code = StripComments(text);
  std::vector<std::string> violations;
  for (std::sregex_iterator it(code.begin(), code.end(), kField), end; it != end; ++it) {
    const std::string name = (*it)[1];
    bool known = PureNumbers().count(name) > 0;
    for (const char* suffix : kSuffixes) known = known || absl::EndsWith(name, suffix);
    if (!known) violations.push_back(absl::StrCat(path, ": ", name, " does not say its unit"));
  }
  return violations;
}

namespace {

// A message, enum or oneof that is open at a place in the text.
struct Block {
  std::string kind;
  std::string name;
  std::set<int> numbers;  // used or reserved
};

// Adds "8", "8, 9" or "8 to 11".
void AddReserved(const std::string& list, std::set<int>& numbers) {
  static const std::regex kRange(R"((\d+)(?:\s+to\s+(\d+))?)");
  for (std::sregex_iterator it(list.begin(), list.end(), kRange), end; it != end; ++it) {
    const int first = std::stoi((*it)[1]);
    const int last = (*it)[2].matched ? std::stoi((*it)[2]) : first;
    for (int number = first; number <= last; ++number) numbers.insert(number);
  }
}

void AddGaps(const std::string& path, const Block& block, std::vector<std::string>& violations) {
  if (block.numbers.empty() || (block.kind != "message" && block.kind != "enum")) return;
  const int first = block.kind == "enum" ? 0 : 1;
  for (int number = first; number < *block.numbers.rbegin(); ++number) {
    if (block.numbers.count(number) > 0) continue;
    violations.push_back(
        absl::StrCat(path, ": ", block.name, " neither uses nor reserves ", number));
  }
}

}  // namespace

std::vector<std::string> CheckNumbers(const std::string& path, const std::string& text) {
  static const std::regex kToken(
      R"((message|enum|oneof)\s+(\w+)\s*\{|(\{)|(\})|=\s*(\d+)\s*(?:\[[^\]]*\])?;)"
      R"(|reserved\s([^;]*);)");
  const std::string code = StripComments(text);
  std::vector<Block> open;
  std::vector<std::string> violations;
  for (std::sregex_iterator it(code.begin(), code.end(), kToken), end; it != end; ++it) {
    const std::smatch& token = *it;
    if (token[1].matched || token[3].matched) {
      open.push_back({token[1], token[2], {}});
    } else if (open.empty()) {
      continue;
    } else if (token[5].matched) {
      open.back().numbers.insert(std::stoi(token[5]));
    } else if (token[6].matched) {
      AddReserved(token[6], open.back().numbers);
    } else {
      const Block closed = open.back();
      open.pop_back();
      AddGaps(path, closed, violations);
      if (closed.kind == "oneof") {
        open.back().numbers.insert(closed.numbers.begin(), closed.numbers.end());
      }
    }
  }
  return violations;
}

}  // namespace plumescout
