// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/source_tree.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"

namespace plumescout {
namespace {

constexpr const char* kRoots[] = {"client",        "core",  "formats", "lab",
                                  "ompl_planners", "proto", "server",  "tests"};

// Copies code and blanks out what is none.
class Stripper {
 public:
  explicit Stripper(const std::string& text) : text_(text) {}

  std::string Strip() {
    while (at_ < text_.size()) {
      if (Ahead("//")) {
        BlankUntil("\n", 0);
      } else if (Ahead("/*")) {
        BlankUntil("*/", 2);
      } else if (Ahead("R\"")) {
        BlankRawString();
      } else if (text_[at_] == '"' || (text_[at_] == '\'' && !InNumber())) {
        BlankLiteral(text_[at_]);
      } else {
        result_ += text_[at_++];
      }
    }
    return result_;
  }

 private:
  bool Ahead(absl::string_view token) const {
    return absl::StartsWith(absl::string_view(text_).substr(at_), token);
  }
  // Whether the quote at hand parts the digits of a number.
  bool InNumber() const { return at_ > 0 && absl::ascii_isalnum(text_[at_ - 1]) != 0; }
  void BlankTo(std::size_t end) {
    for (; at_ < std::min(end, text_.size()); ++at_) result_ += text_[at_] == '\n' ? '\n' : ' ';
  }
  void BlankUntil(const std::string& token, std::size_t extra) {
    const std::size_t end = text_.find(token, at_ + 1);
    BlankTo(end == std::string::npos ? text_.size() : end + extra);
  }
  void BlankRawString() {
    const std::size_t open = text_.find('(', at_);
    if (open == std::string::npos) return BlankTo(text_.size());
    const std::string close =
        absl::StrCat(")", absl::string_view(text_).substr(at_ + 2, open - at_ - 2), "\"");
    BlankUntil(close, close.size());
  }
  void BlankLiteral(char quote) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote) end += text_[end] == '\\' ? 2 : 1;
    BlankTo(end + 1);
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::string result_;
};

// Reads `#include <name>` and `#include "name"` off one line.
void AddInclude(absl::string_view line, SourceFile& file) {
  line = absl::StripLeadingAsciiWhitespace(line);
  if (!absl::ConsumePrefix(&line, "#include")) return;
  line = absl::StripLeadingAsciiWhitespace(line);
  const bool quoted = absl::StartsWith(line, "\"");
  const std::size_t end = line.find(quoted ? '"' : '>', 1);
  if (line.empty() || end == absl::string_view::npos) return;
  (quoted ? file.quoted_includes : file.system_includes).emplace_back(line.substr(1, end - 1));
}

}  // namespace

bool SourceFile::is_header() const { return absl::EndsWith(path, ".h"); }

std::string SourceFile::folder() const { return FolderOf(path); }

std::string FolderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string StripComments(const std::string& text) { return Stripper(text).Strip(); }

SourceFile ParseSource(const std::string& path, const std::string& text) {
  SourceFile file{path, text, StripComments(text), {}, {}};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) AddInclude(line, file);
  return file;
}

std::vector<std::string> ListFiles(const std::string& folder, const std::string& extension) {
  namespace fs = std::filesystem;
  std::vector<std::string> paths;
  if (!fs::is_directory(folder)) return paths;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == extension) {
      paths.push_back(entry.path().generic_string());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string ReadText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<SourceFile> ReadSourceTree() {
  std::vector<SourceFile> files;
  for (const char* root : kRoots) {
    for (const char* extension : {".cc", ".h"}) {
      for (const std::string& path : ListFiles(root, extension)) {
        files.push_back(ParseSource(path, ReadText(path)));
      }
    }
  }
  return files;
}

}  // namespace plumescout
