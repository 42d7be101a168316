// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lab/sim/layout.h"

namespace plumescout::lab {

// Six dead-end rooms on both sides of a corridor, everything with doors and lanes of 0.8 m, which
// two robots of 0.2 m cannot pass each other in. Where the doors are and which two rooms have a
// leak is drawn from the seed; the start is in a room without. The same seed gives the same layout.
Layout OneLaneLayout(std::uint64_t seed);

}  // namespace plumescout::lab
