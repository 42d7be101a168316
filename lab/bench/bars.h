// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plumescout::lab {

// A figure and what it may be at most; without a limit it is for information.
struct Bar {
  std::string name;  // with its unit
  double value = 0.0;
  std::optional<double> limit = std::nullopt;

  // What was not measured (NaN) is not met.
  bool met() const { return !limit.has_value() || value <= *limit; }
};

// A fact that must be: 1 if it is not, and at most 0.
Bar MustHold(const std::string& name, bool holds);

bool AllMet(const std::vector<Bar>& bars);

// "plan p99, ms: 12.3 (at most 60)", and "MISSED" behind a figure that is too high.
std::string ToString(const Bar& bar);

}  // namespace plumescout::lab
