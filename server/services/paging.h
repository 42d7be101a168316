// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"

namespace plumescout::server {

// Which page of a list by name is wanted.
struct Page {
  std::string after;  // names after this one; empty: from the beginning
  int size = 0;
};

// `size` 0: 100; above 1000: 1000. Refuses negative sizes and tokens of no list.
absl::StatusOr<Page> ReadPage(int size, const std::string& token);

// Where the page after this name begins.
std::string PageTokenAfter(const std::string& last);

}  // namespace plumescout::server
