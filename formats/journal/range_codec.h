// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/strings/string_view.h"

namespace plumescout {

// The ranges of a scan as bytes, of which every bit comes back. Lidars measure in steps of a unit,
// and neighbouring beams differ by few of them. So if each range is the float nearest to a whole
// number of units of some 0.1 mm to 100 mm, its difference from the beam before is kept, mostly in
// one byte; else the floats are.
//
//   varint number of beams | varint unit in micrometres, and for each beam a varint: 0 for
//                            +infinity, 1 for NaN, 2 + the zigzagged difference, in units, from the
//                            last beam that had a range
//                          | 0, and for each beam a float
//
// Appends to `bytes`. Cost: O(beams).
void AppendRanges(const std::vector<float>& ranges_m, std::string& bytes);

// Takes ranges off the front of `rest`. False, with `rest` and `ranges_m` anywhere, if there are
// none. Memory: O(bytes of `rest`), whatever the number of beams says.
bool TakeRanges(absl::string_view& rest, std::vector<float>& ranges_m);

}  // namespace plumescout
