// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/paging.h"

#include <algorithm>

#include "absl/strings/escaping.h"
#include "core/types/ids.h"
#include "proto/convert/field.h"

namespace plumescout::server {
namespace {

constexpr int kDefaultSize = 100;
constexpr int kMaxSize = 1000;

}  // namespace

absl::StatusOr<Page> ReadPage(int size, const std::string& token) {
  if (size < 0) return FieldError("page_size", size, "must be >= 0");
  Page page{.after = {}, .size = size == 0 ? kDefaultSize : std::min(size, kMaxSize)};
  if (token.empty()) return page;
  if (!absl::WebSafeBase64Unescape(token, &page.after) ||
      !ValidateId("id", page.after.substr(page.after.rfind('/') + 1)).ok()) {
    return FieldError("page_token", token, "is not a token of this list");
  }
  return page;
}

// Armoured, so that nobody builds one by hand.
std::string PageTokenAfter(const std::string& last) { return absl::WebSafeBase64Escape(last); }

}  // namespace plumescout::server
