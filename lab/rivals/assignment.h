// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace plumescout::lab {

// The column of each row so that no column is taken twice and the sum of costs is least: the
// Hungarian method of Kuhn (1955), by shortest augmenting paths. Of equal sums one is found, always
// the same. REQUIRES: rows of one length, no fewer columns than rows, finite costs.
// Cost: O(rows^2 * columns).
std::vector<std::size_t> LeastAssignment(const std::vector<std::vector<double>>& costs);

}  // namespace plumescout::lab
