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
    "_m",        "_rad",   "_s",          "_ns",     "_mps",      "_mps2",        "_hz",
    "_ppm",      "_ppm2",  "_per_m",      "_ratio",  "_per_ppm2", "_probability", "_nats",
    "_log_odds", "_share", "_percentile", "_factor", "_count",    "_sequence",    "_revision",
    "_column",   "_row",   "_columns",    "_rows",   "_index"};

// Numbers that have no unit.
const std::set<std::string>& PureNumbers() {
  static const std::set<std::string> names = {
      "beta",                 // weight, [XIT] Eq. (8)
      "column",               // of a cell
      "cost",                 // J, [XIT] Eq. (13): its unit follows from the strategy
      "fallback_limit",       // a count
      "information_penalty",  // [XIT] Eq. (12), of a path
      "lease_token",          // opaque
      "mean_ucb",             // in [0, 1], [MIT] Eq. (3)
      "page_size",            // a count
      "revision",             // of a mission
      "reward",               // of sampling sites: its unit follows from which reward it is
      "row",                  // of a cell
      "seed",                 // opaque
      "sequence",             // of an observation
      "survey_stride",        // in sites
      "sweep_leg_stride",     // in rows of sites
      "sweep_stride",         // in sites
      "value_offset",         // in the unit of the raster's layer
      "value_scale",          // in the unit of the raster's layer
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

}  // namespace plumescout
