// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "lab/sim/layout.h"

namespace plumescout::lab {

// YAML that ParseLayout reads back as the same layout; sources in the order of their ids. Numbers
// are as short as reads back exactly. REQUIRES: the layout is valid.
std::string FormatLayout(const Layout& layout);

// The same into a file. kInvalidArgument if the layout is invalid; else as WriteFile.
absl::Status WriteLayout(const Layout& layout, const std::string& path);

}  // namespace plumescout::lab
