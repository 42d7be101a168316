// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "lab/experiments/trial.h"

namespace plumescout::lab {

// Finished trials of a study, on disk: FOLDER/NAME.json, and FOLDER/NAME.map-K.npy for its maps.
// A study that is begun again finds them here.
class TrialStore {
 public:
  // Makes the folder if need be. Errors: kUnavailable.
  static absl::StatusOr<TrialStore> Open(const std::string& folder);

  // What was kept under this name with this fingerprint; none if there is nothing, if it is of
  // other settings, or if it does not read.
  std::optional<TrialRecord> Find(const std::string& name, const std::string& fingerprint,
                                  const GridGeometry& geometry) const;
  // Replaces what the name had. Errors: as WriteFile and WriteNpy.
  absl::Status Keep(const std::string& name, const std::string& fingerprint,
                    const TrialRecord& record) const;

 private:
  explicit TrialStore(std::string folder) : folder_(std::move(folder)) {}

  std::string JsonPath(const std::string& name) const;
  std::string MapPath(const std::string& name, std::size_t map) const;

  std::string folder_;
};

// Tells trials apart: settings, building, seed and times. Not the program itself: a folder of
// trials belongs to one build.
std::string Fingerprint(const Trial& trial);
// The building's part of it: a checksum of map and gas. Cost: O(frames * cells).
std::uint32_t SceneChecksum(const Scene& scene);

}  // namespace plumescout::lab
