// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/rng.h"
#include "tests/fuzz/request_steps.h"

namespace plumescout::fuzz {

// Changes a request, or removes, swaps, repeats or adds one.
void MutateSteps(Steps& steps, Rng& rng);

}  // namespace plumescout::fuzz
