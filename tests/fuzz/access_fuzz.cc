// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What says who calls: lines of token files and subjects of certificates.

#include <cstdint>

#include "absl/strings/string_view.h"
#include "server/access/subject.h"
#include "server/access/token_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const absl::string_view text(reinterpret_cast<const char*>(data), size);
  plumescout::server::ParseTokenLine(text).status().IgnoreError();
  const auto name = plumescout::server::CommonNameOf(text);
  const auto principal = plumescout::server::PrincipalOfSubject(text);
  // Who has no name is nobody.
  if (principal.ok() && !name.ok()) __builtin_trap();
  return 0;
}
