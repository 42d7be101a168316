// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumescout::lab {

// Round numbers (1, 2 or 5 times a power of ten apart) within [low, high], about `count` of them.
// REQUIRES: low < high, both finite, count > 0.
std::vector<double> LinearTicks(double low, double high, int count);

// Powers of ten within [low, high]. REQUIRES: 0 < low < high, both finite.
std::vector<double> DecadeTicks(double low, double high);

// The greatest round number (1, 2 or 5 times a power of ten) that is at most `limit` > 0.
double RoundDown125(double limit);

// A number as short as it can be said to four digits.
std::string TickLabel(double value);

}  // namespace plumescout::lab
