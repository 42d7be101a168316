// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/statusor.h"

namespace plumescout::server {

// How many descriptors the process may open: `before` and now.
struct DescriptorLimit {
  std::int64_t before = 0;
  std::int64_t now = 0;
};

// Lets the process open as many descriptors as the system allows: every connection takes one, and
// gRPC's listener stops listening for good when it finds none left.
absl::StatusOr<DescriptorLimit> RaiseDescriptorLimit();

}  // namespace plumescout::server
