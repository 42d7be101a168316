// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/option_rules.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "absl/strings/str_cat.h"
#include "tests/architecture/source_tree.h"

namespace plumescout {
namespace {

using Fields = std::map<std::string, std::set<std::string>>;  // names, by message or struct

// What `field` finds in the bodies that `head` begins: messages and structs of options hold no
// braces but those of initial values.
Fields Collect(const std::string& text, const std::string& head, const std::string& field) {
  const std::regex body_begin(head + R"(\s+(\w+(?:Options|Config))\s*\{)");
  const std::regex member(field);
  const std::string code = StripComments(text);
  Fields found;
  for (std::sregex_iterator it(code.begin(), code.end(), body_begin), end; it != end; ++it) {
    const auto begin = static_cast<std::size_t>(it->position() + it->length());
    const std::string body = code.substr(begin, code.find("\n}", begin) - begin);
    std::set<std::string>& names = found[(*it)[1]];
    for (std::sregex_iterator hit(body.begin(), body.end(), member), last; hit != last; ++hit) {
      names.insert((*hit)[1]);
    }
  }
  return found;
}

void Compare(const std::string& name, const std::set<std::string>& have,
             const std::set<std::string>& want, const std::string& where,
             std::vector<std::string>& violations) {
  std::vector<std::string> missing;
  std::set_difference(want.begin(), want.end(), have.begin(), have.end(),
                      std::back_inserter(missing));
  for (const std::string& field : missing) {
    violations.push_back(absl::StrCat(name, ".", field, " is missing in ", where));
  }
}

}  // namespace

std::vector<std::string> CheckOptionNames(const std::string& proto, const std::string& header) {
  // "= 3;" ends a field of a message; a member ends with its initial value, or with its name.
  const Fields messages = Collect(proto, "message", R"((\w+)\s*=\s*\d+\s*;)");
  const Fields structs = Collect(header, "struct", R"(\s(\w+)\s*(?:=[^;]*|\{[^;]*\})?;)");
  std::vector<std::string> violations;
  for (const auto& [name, fields] : messages) {
    const auto found = structs.find(name);
    if (found == structs.end()) {
      violations.push_back(absl::StrCat(name, " has no struct"));
      continue;
    }
    Compare(name, found->second, fields, "the struct", violations);
    Compare(name, fields, found->second, "the message", violations);
  }
  for (const auto& [name, fields] : structs) {
    if (messages.count(name) == 0) violations.push_back(absl::StrCat(name, " has no message"));
  }
  return violations;
}

}  // namespace plumescout
