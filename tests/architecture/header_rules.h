// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace plumescout {

// Headers are read after precompiled ones, and sources several at a time, so a compiler does not
// notice that a header names what it does not include. One line for each
// * name of the standard library or abseil that a header uses, of those that are most used, though
//   neither it nor a header of ours that it includes, however indirectly, includes what declares
//   it;
// * source that does not include the header of its name before all others.
std::vector<std::string> CheckHeaders(const std::vector<SourceFile>& files);

}  // namespace plumescout
