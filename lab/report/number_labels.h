// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lab/formats/summary.h"

namespace plumescout::lab {

// The figures of a run as people read them, and what they were measured on: "plan_cpu_ms_p50" with
// 19.04 becomes {"Plan, CPU, median", "19 ms"}. Three digits; figures that were not measured are
// left out. A name that has no label stands as it is.
std::vector<std::pair<std::string, std::string>> LabelledNumbers(const Summary& summary);

}  // namespace plumescout::lab
