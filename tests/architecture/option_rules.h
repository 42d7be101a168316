// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumescout {

// One name for an option everywhere: each message of the .proto text whose name ends in Options or
// Config has a struct of the same name in the header's text, and both have fields of the same
// names. A line for each that the other lacks.
std::vector<std::string> CheckOptionNames(const std::string& proto, const std::string& header);

}  // namespace plumescout
