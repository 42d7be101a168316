// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"

namespace plumescout::lab {

// The figures of one run, for programs to read.
struct Summary {
  // Name and value, in the order of writing. A value that is not finite was not measured.
  std::vector<std::pair<std::string, double>> figures;
  // How they came about: machine, load, build type, seed, version.
  std::vector<std::pair<std::string, std::string>> about;
};

// Writes one flat JSON object, name to number, and "about" as the one nested value. Figures that
// were not measured are left out. Numbers are as short as reads back exactly. kInvalidArgument if
// a name is empty, "about", or comes twice; else as WriteFile.
absl::Status WriteSummary(const Summary& summary, const std::string& path);

}  // namespace plumescout::lab
