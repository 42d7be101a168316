// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace plumescout {

// The headers that `cmake_lists`, of the folder, installs for others to build with: those of
// plumescout_publish(... HEADERS ...).
std::vector<std::string> PublishedHeaders(const std::string& folder,
                                          const std::string& cmake_lists);

// The line between product and laboratory: sources outside lab/ and tests/ that neither a program
// of the product nor the published client library needs, one line each. Who includes a header needs
// the sources that define what it declares: the one of its name, and those that have no header of
// their own and include it first of their folder's.
std::vector<std::string> CheckReachability(const std::vector<SourceFile>& files,
                                           const std::vector<std::string>& published);

}  // namespace plumescout
