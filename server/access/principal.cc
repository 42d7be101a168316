// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/principal.h"

#include <algorithm>
#include <array>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "core/types/ids.h"
#include "core/types/status_macros.h"

namespace plumescout::server {
namespace {

constexpr std::array<Role, 4> kRoles = {Role::kRobot, Role::kViewer, Role::kOperator, Role::kAdmin};
constexpr std::size_t kMaxWordLength = 64;

absl::Status CheckWord(absl::string_view what, absl::string_view word) {
  const bool ok = !word.empty() && word.size() <= kMaxWordLength &&
                  std::all_of(word.begin(), word.end(), [](char c) {
                    return absl::ascii_isgraph(static_cast<unsigned char>(c));
                  });
  if (ok) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(what, " \"",
                                                 absl::CHexEscape(word.substr(0, kMaxWordLength)),
                                                 "\" must be 1 to 64 visible ASCII characters"));
}

absl::StatusOr<Role> ReadRole(absl::string_view word) {
  for (const Role role : kRoles) {
    if (RoleName(role) == word) return role;
  }
  return absl::InvalidArgumentError(absl::StrCat("role \"",
                                                 absl::CHexEscape(word.substr(0, kMaxWordLength)),
                                                 "\" must be robot, viewer, operator or admin"));
}

}  // namespace

absl::string_view RoleName(Role role) {
  switch (role) {
    case Role::kRobot:
      return "robot";
    case Role::kViewer:
      return "viewer";
    case Role::kOperator:
      return "operator";
    case Role::kAdmin:
      return "admin";
  }
  return "";
}

absl::StatusOr<Principal> MakePrincipal(absl::string_view name, absl::string_view role,
                                        absl::string_view tenant) {
  Principal principal;
  PLUMESCOUT_RETURN_IF_ERROR(CheckWord("name", name));
  if (!tenant.empty()) PLUMESCOUT_RETURN_IF_ERROR(CheckWord("tenant", tenant));
  // It names folders.
  if (absl::StrContains(tenant, '/') || tenant == "." || tenant == "..") {
    return absl::InvalidArgumentError(
        absl::StrCat("tenant \"", tenant, "\" must have no /, and not be . or .."));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(principal.role, ReadRole(role));
  if (principal.role == Role::kRobot) PLUMESCOUT_RETURN_IF_ERROR(ValidateId("name", name));
  principal.name = std::string(name);
  principal.tenant = std::string(tenant);
  principal.own_robot_only = principal.role == Role::kRobot;
  return principal;
}

}  // namespace plumescout::server
