// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace plumescout {

// Each returns one line per violation.

// Sources without a test of the same name in the same place below tests/, unless the list in
// file_rules.cc excuses them; excuses that are no longer needed.
std::vector<std::string> CheckMirror(const std::vector<SourceFile>& files);

// Files without the two-line licence header; headers without #pragma once or with a using
// directive.
std::vector<std::string> CheckFrames(const std::vector<SourceFile>& files);

}  // namespace plumescout
