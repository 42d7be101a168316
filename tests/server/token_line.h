// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "server/access/token_file.h"

namespace plumescout::server {

// The line of a file of tokens; `rest` is "NAME ROLE TENANT EXPIRY".
inline std::string TokenLine(const std::string& token, const std::string& rest) {
  const Sha256 hash = HashOf(token);
  const absl::string_view bytes(reinterpret_cast<const char*>(hash.data()), hash.size());
  return absl::StrCat(absl::BytesToHexString(bytes), " ", rest, "\n");
}

}  // namespace plumescout::server
