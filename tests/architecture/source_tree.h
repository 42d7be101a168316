// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumescout {

struct SourceFile {
  std::string path;  // relative to the root of the project, e.g. "core/gas/gas_map.h"
  std::string text;
  std::string code;  // text with comments and the contents of literals blanked out, line by line
  // What it includes, as written: core/gas/gas_map.h, vector.
  std::vector<std::string> quoted_includes;
  std::vector<std::string> system_includes;

  bool is_header() const;
  std::string folder() const;  // "core/gas"
};

// "core/gas" of "core/gas/gas_map.h"; empty if it lies in none.
std::string FolderOf(const std::string& path);

// `path` names the file, which need not exist.
SourceFile ParseSource(const std::string& path, const std::string& text);

// Every .h and .cc of the project below the current directory, in the order of their paths.
std::vector<SourceFile> ReadSourceTree();

// Every file below `folder` whose name ends in `extension`.
std::vector<std::string> ListFiles(const std::string& folder, const std::string& extension);

// The file's text, empty if there is none.
std::string ReadText(const std::string& path);

// Comments and the contents of string and character literals become blanks; lines stay.
std::string StripComments(const std::string& text);

}  // namespace plumescout
