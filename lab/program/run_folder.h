// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "core/types/map_snapshot.h"
#include "lab/program/run.h"

namespace plumescout::lab {

// Writes map.pgm + map.yaml, gas_mean.npy and gas_variance.npy into `folder`, which is made if it
// is not there; of further gases gas_mean_ozone.npy and so on. The same map gives the same bytes.
absl::Status WriteMapFiles(const MapSnapshot& map, const std::string& folder);

// Writes report.html, report.png, metrics.csv, summary.json and the files of the map into `folder`,
// which is made if it is not there.
absl::Status WriteRunFolder(const Run& run, const std::string& folder);

}  // namespace plumescout::lab
