// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "server/access/principal.h"

namespace plumescout::server {

// One part of a certificate's subject: type "OU", value "robot".
struct SubjectPart {
  std::string type;
  std::string value;

  friend bool operator==(const SubjectPart&, const SubjectPart&) = default;
};

// The parts of a subject that is written as RFC 2253 has it ("CN=scout,OU=robot,O=acme"), without
// its escapes. kInvalidArgument if it is not written so.
absl::StatusOr<std::vector<SubjectPart>> ParseSubject(absl::string_view subject);

// The one common name. kInvalidArgument if there is none, or more.
absl::StatusOr<std::string> CommonNameOf(absl::string_view subject);

// Whom a subject names: CN is the name, OU the role, O the tenant, which may be missing. Each
// stands there once at most: who has two roles has none. kInvalidArgument.
absl::StatusOr<Principal> PrincipalOfSubject(absl::string_view subject);

}  // namespace plumescout::server
