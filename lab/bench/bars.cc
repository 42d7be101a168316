// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/bars.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace plumescout::lab {

Bar MustHold(const std::string& name, bool holds) { return {name, holds ? 0.0 : 1.0, 0.0}; }

bool AllMet(const std::vector<Bar>& bars) {
  return std::all_of(bars.begin(), bars.end(), [](const Bar& bar) { return bar.met(); });
}

std::string ToString(const Bar& bar) {
  std::string text = absl::StrFormat("%s: %.4g", bar.name, bar.value);
  if (!bar.limit.has_value()) return text;
  absl::StrAppendFormat(&text, " (at most %.4g)", *bar.limit);
  if (!bar.met()) absl::StrAppend(&text, " MISSED");
  return text;
}

}  // namespace plumescout::lab
