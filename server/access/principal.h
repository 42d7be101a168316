// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout::server {

// What a caller may do, see server/access/rpc.h.
enum class Role { kRobot, kViewer, kOperator, kAdmin };

// "robot", "viewer", "operator", "admin".
absl::string_view RoleName(Role role);

// Who calls. Missions belong to tenants: who is of another tenant and no admin is told that they
// are not there.
struct Principal {
  std::string name = "anonymous";
  std::string tenant = {};
  Role role = Role::kAdmin;
  // Its robot is the only one that it may act for: that of its own name. Set for role kRobot.
  bool own_robot_only = false;

  friend bool operator==(const Principal&, const Principal&) = default;
};

// Whom certificates and files of tokens name by these words. Name and tenant are 1 to 64 visible
// ASCII characters, the name of a robot is its id, and the tenant has no slash, which parts it from
// names, and may be empty. kInvalidArgument naming the word.
absl::StatusOr<Principal> MakePrincipal(absl::string_view name, absl::string_view role,
                                        absl::string_view tenant);

}  // namespace plumescout::server
