// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace plumescout {

struct FunctionSize {
  std::string head;    // e.g. "int Add(int a, int b)"
  int code_lines = 0;  // from the opening brace to the closing one
};

// Lines of the file that are neither blank, comment nor preprocessor.
int CountCodeLines(const SourceFile& file);

// Bodies of functions at the scope of files, namespaces and classes, found by their braces; a
// lambda belongs to the function around it. Macros that look like functions (TEST) count as such.
std::vector<FunctionSize> MeasureFunctions(const SourceFile& file);

// Files and functions beyond their limits, one line each.
std::vector<std::string> CheckSizes(const std::vector<SourceFile>& files);

}  // namespace plumescout
