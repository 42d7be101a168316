// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <string>

#include "absl/status/statusor.h"
#include "lab/bags/bag_reader.h"

namespace plumescout::lab {

// As OpenBag, of an MCAP file: chunks not packed, or by zstd.
absl::StatusOr<std::unique_ptr<BagReader>> OpenMcapBag(const std::string& path,
                                                       const std::set<std::string>& wanted_topics);

}  // namespace plumescout::lab
