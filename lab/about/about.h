// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace plumescout::lab {

// Of the program: "0.1.0".
std::string CodeVersion();

// How figures of this process come about, for Summary::about: machine (CPU model), load (runnable
// processes over the last minute), build_type, seed, version.
std::vector<std::pair<std::string, std::string>> AboutThisRun(std::uint64_t seed);

}  // namespace plumescout::lab
