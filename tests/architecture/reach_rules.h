// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace plumescout {

// The line between product and laboratory: sources outside lab/ and tests/ that neither a program
// of the product nor the published client library needs, one line each. Who includes a header needs
// the sources that define what it declares: the one of its name, and those that have no header of
// their own and include it first.
std::vector<std::string> CheckReachability(const std::vector<SourceFile>& files);

}  // namespace plumescout
