// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "lab/sim/layout.h"

namespace plumescout::lab {

// A layout of lab/scenes that the program carries along, by its file's name without ".yaml":
// "co2_trial", "industrial_16x20". kNotFound for another; else as ParseLayout.
absl::StatusOr<Layout> BundledLayout(const std::string& name);

}  // namespace plumescout::lab
