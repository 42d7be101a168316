// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/ids.h"

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"

namespace plumescout {

absl::Status ValidateId(absl::string_view field, absl::string_view id) {
  constexpr std::size_t kMaxLength = 63;
  const auto is_word = [](char c) { return absl::ascii_islower(c) || absl::ascii_isdigit(c); };
  const bool ok = !id.empty() && id.size() <= kMaxLength && absl::ascii_islower(id.front()) &&
                  is_word(id.back()) &&
                  std::all_of(id.begin(), id.end(), [&](char c) { return is_word(c) || c == '-'; });
  if (ok) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(field, " = \"", absl::CHexEscape(id.substr(0, 80)),
                                                 "\" must match [a-z]([a-z0-9-]{0,61}[a-z0-9])?"));
}

}  // namespace plumescout
