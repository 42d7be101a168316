// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumescout {

// What the map says of a cell. [XIT] Eq. (1): free if p <= tau_free.
enum class CellState : std::uint8_t { kUnknown = 0, kFree = 1, kOccupied = 2 };

}  // namespace plumescout
