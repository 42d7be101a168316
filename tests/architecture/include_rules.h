// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace plumescout {

// Each returns one line per violation.

// Includes against the directions of the table in include_rules.cc, or of no known folder; quoted
// includes that are not relative to the root.
std::vector<std::string> CheckDirections(const std::vector<SourceFile>& files);

// Cycles of files, and of folders, each subfolder a folder of its own; one line each, with the way
// round.
std::vector<std::string> CheckCycles(const std::vector<SourceFile>& files);

// Headers of the platform where they must not be: protobuf, gRPC, threads, files, clocks and global
// random numbers in core; CHOLMOD and GLPK outside their one file; OMPL outside ompl_planners; gRPC
// and generated code in headers that others include.
std::vector<std::string> CheckPlatformHeaders(const std::vector<SourceFile>& files);

// Words in core that reach for a clock, chance, the environment or the console without a header.
std::vector<std::string> CheckImpureCalls(const std::vector<SourceFile>& files);

}  // namespace plumescout
