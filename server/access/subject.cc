// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/subject.h"

#include <cstddef>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::server {
namespace {

constexpr std::size_t kMaxSubjectLength = 1024;

absl::Status NoSubject(absl::string_view subject) {
  return absl::InvalidArgumentError(absl::StrCat("the subject \"",
                                                 absl::CHexEscape(subject.substr(0, 80)),
                                                 "\" is not written as RFC 2253 has it"));
}

bool IsHexPair(absl::string_view text) {
  return text.size() >= 2 && absl::ascii_isxdigit(static_cast<unsigned char>(text[0])) &&
         absl::ascii_isxdigit(static_cast<unsigned char>(text[1]));
}

// Takes what is escaped off the head of `rest`, which a backslash came before; false if there is
// nothing.
bool TakeEscaped(absl::string_view& rest, std::string& value) {
  if (rest.empty()) return false;
  const std::size_t length = IsHexPair(rest) ? 2 : 1;
  value += length == 2 ? absl::HexStringToBytes(rest.substr(0, 2)) : std::string(1, rest[0]);
  rest.remove_prefix(length);
  return true;
}

// Takes a value and the comma or plus that ends it off the head of `rest`.
bool TakeValue(absl::string_view& rest, std::string& value) {
  while (!rest.empty()) {
    const char c = rest.front();
    rest.remove_prefix(1);
    if (c == ',' || c == '+') return !rest.empty();                  // another part has to follow
    if (c == '"' || c == ';' || c == '<' || c == '>') return false;  // to be escaped
    if (c != '\\') {
      value += c;
    } else if (!TakeEscaped(rest, value)) {
      return false;
    }
  }
  return true;
}

absl::Status SetOnce(const SubjectPart& part, std::string& value) {
  if (value.empty() && !part.value.empty()) {
    value = part.value;
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      absl::StrCat("the subject has several ", part.type, ", or an empty one"));
}

}  // namespace

absl::StatusOr<std::vector<SubjectPart>> ParseSubject(absl::string_view subject) {
  std::vector<SubjectPart> parts;
  if (subject.size() > kMaxSubjectLength) return NoSubject(subject);
  absl::string_view rest = subject;
  while (!rest.empty()) {
    const std::size_t equals = rest.find('=');
    if (equals == 0 || equals == absl::string_view::npos) return NoSubject(subject);
    SubjectPart part;
    part.type = std::string(rest.substr(0, equals));
    rest.remove_prefix(equals + 1);
    // Bytes in place of text are for types that have no name.
    const bool is_bytes = !rest.empty() && rest.front() == '#';
    if (is_bytes && !absl::ascii_isdigit(static_cast<unsigned char>(part.type[0]))) {
      return NoSubject(subject);
    }
    if (!TakeValue(rest, part.value)) return NoSubject(subject);
    parts.push_back(std::move(part));
  }
  return parts;
}

absl::StatusOr<std::string> CommonNameOf(absl::string_view subject) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<SubjectPart> parts, ParseSubject(subject));
  std::string name;
  for (const SubjectPart& part : parts) {
    if (part.type == "CN") PLUMESCOUT_RETURN_IF_ERROR(SetOnce(part, name));
  }
  if (name.empty()) return absl::InvalidArgumentError("the subject has no CN");
  return name;
}

absl::StatusOr<Principal> PrincipalOfSubject(absl::string_view subject) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<SubjectPart> parts, ParseSubject(subject));
  std::string name;
  std::string role;
  std::string tenant;
  for (const SubjectPart& part : parts) {
    if (part.type == "CN") PLUMESCOUT_RETURN_IF_ERROR(SetOnce(part, name));
    if (part.type == "OU") PLUMESCOUT_RETURN_IF_ERROR(SetOnce(part, role));
    if (part.type == "O") PLUMESCOUT_RETURN_IF_ERROR(SetOnce(part, tenant));
  }
  if (role.empty()) return absl::InvalidArgumentError("the subject names no role (OU)");
  return MakePrincipal(name, role, tenant);
}

}  // namespace plumescout::server
