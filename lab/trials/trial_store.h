// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "lab/trials/trial.h"

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

// A checksum of map and gas. Cost: O(frames * cells), tens of megabytes.
std::uint32_t SceneChecksum(const Scene& scene);
// Tells trials apart: settings, building, seed and times. Not the program itself: a folder of
// trials belongs to one build. `scene_checksum` is that of the trial's world.
std::string Fingerprint(const Trial& trial, std::uint32_t scene_checksum);

}  // namespace plumescout::lab
