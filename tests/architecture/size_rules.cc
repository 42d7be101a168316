// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/size_rules.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"

namespace plumescout {
namespace {

constexpr int kMaxSourceLines = 350;
constexpr int kMaxHeaderLines = 180;
constexpr int kMaxFunctionLines = 60;

bool IsCodeLine(absl::string_view line) {
  line = absl::StripLeadingAsciiWhitespace(line);
  return !line.empty() && line.front() != '#';
}

int CountLines(const std::string& code) {
  int count = 0;
  std::istringstream lines(code);
  for (std::string line; std::getline(lines, line);) count += IsCodeLine(line) ? 1 : 0;
  return count;
}

std::string WithoutPreprocessor(const std::string& code) {
  std::string result;
  std::istringstream lines(code);
  bool continued = false;  // the last line was a directive that goes on
  for (std::string line; std::getline(lines, line);) {
    const bool directive =
        continued || absl::StartsWith(absl::StripLeadingAsciiWhitespace(line), "#");
    continued = directive && absl::EndsWith(line, "\\");
    result += directive ? "\n" : line + "\n";
  }
  return result;
}

// What a pair of braces holds. kWithinHead: an initialiser before the body of a function, such as
// "a_{1}" or a default argument; clang-format leaves no blank before it.
enum class Braces { kScope, kFunction, kWithinHead, kOther };

// What an opening brace after `head` begins. `head` is the code since the last ; { or }.
Braces Classify(const std::string& head) {
  static const std::regex kScopeWord(
      R"(^\s*(template\s*<.*>\s*)?(inline\s+)?(namespace|class|struct|union|enum|extern)\b)");
  static const std::regex kParameters(R"(\([^]*\))");
  static const std::regex kOperator(R"(operator\s*[^\s\w(]+)");
  const auto count = [&head](char c) { return std::count(head.begin(), head.end(), c); };
  if (count('(') != count(')')) return Braces::kWithinHead;
  const std::size_t parenthesis = head.find('(');
  if (std::regex_search(head, kScopeWord) &&
      (parenthesis == std::string::npos || !absl::StrContains(head, ")"))) {
    return Braces::kScope;
  }
  const std::string plain = std::regex_replace(head, kOperator, "operator");
  const std::string outside = std::regex_replace(plain, kParameters, "");
  if (parenthesis == std::string::npos || absl::StrContains(outside, "=")) return Braces::kOther;
  if (absl::ascii_isalnum(head.back()) || head.back() == '_' || head.back() == '>') {
    return Braces::kWithinHead;
  }
  return Braces::kFunction;
}

std::string Shorten(const std::string& head) {
  std::string words = head;
  absl::RemoveExtraAsciiWhitespace(&words);
  constexpr std::size_t kLongest = 80;
  return words.substr(0, kLongest);
}

}  // namespace

int CountCodeLines(const SourceFile& file) { return CountLines(file.code); }

std::vector<FunctionSize> MeasureFunctions(const SourceFile& file) {
  const std::string code = WithoutPreprocessor(file.code);
  std::vector<FunctionSize> functions;
  Braces braces = Braces::kScope;  // around i, if depth > 0
  int depth = 0;                   // of braces that are no scope
  std::size_t head_begin = 0;
  std::size_t body_begin = 0;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (depth == 0 && c == '{') {
      braces = Classify(code.substr(head_begin, i - head_begin));
      body_begin = i;
    }
    if (braces != Braces::kScope) depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    if (depth > 0) continue;
    if (braces == Braces::kFunction) {
      functions.push_back({Shorten(code.substr(head_begin, body_begin - head_begin)),
                           CountLines(code.substr(body_begin, i + 1 - body_begin))});
    }
    const bool head_goes_on = braces == Braces::kWithinHead;
    braces = Braces::kScope;
    if (!head_goes_on && (c == '{' || c == '}' || c == ';')) head_begin = i + 1;
  }
  return functions;
}

std::vector<std::string> CheckSizes(const std::vector<SourceFile>& files) {
  std::vector<std::string> violations;
  for (const SourceFile& file : files) {
    const int limit = file.is_header() ? kMaxHeaderLines : kMaxSourceLines;
    if (const int lines = CountCodeLines(file); lines > limit) {
      violations.push_back(absl::StrCat(file.path, ": ", lines, " code lines, at most ", limit));
    }
    for (const FunctionSize& function : MeasureFunctions(file)) {
      if (function.code_lines <= kMaxFunctionLines) continue;
      violations.push_back(absl::StrCat(file.path, ": ", function.code_lines, " lines, at most ",
                                        kMaxFunctionLines, ", in ", function.head));
    }
  }
  return violations;
}

}  // namespace plumescout
