// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumescout {

// Numbers in the .proto text whose name neither ends in a unit nor stands on the list of pure
// numbers in proto_rules.cc; one line each.
std::vector<std::string> CheckUnits(const std::string& path, const std::string& text);

// Numbers below the largest of a message or enum that are neither used nor reserved: they may have
// meant something to somebody. One line for each.
std::vector<std::string> CheckNumbers(const std::string& path, const std::string& text);

}  // namespace plumescout
