// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "absl/status/statusor.h"

namespace plumescout::server {

struct StaticFile {
  std::string type;     // of its content
  std::string caching;  // what Cache-Control says
  std::string content;
};

// The files of a folder, read once: what is asked for by HTTP never becomes a path of the disk.
class StaticFiles {
 public:
  static constexpr std::size_t kMaxFiles = 256;
  static constexpr std::size_t kMaxBytes = std::size_t{32} << 20;  // of all together

  // None.
  StaticFiles() = default;
  // Those of the folder and the folders in it whose names end as pages, scripts, styles, images and
  // data of pages do; others, and what begins with a dot, are left out. kInvalidArgument if there
  // is no index.html, kResourceExhausted beyond the limits.
  static absl::StatusOr<StaticFiles> Load(const std::string& folder);

  // The same of `folder`, or of share/plumescout/console beside bin/PROGRAM if `folder` is empty;
  // none if nothing is installed there.
  static absl::StatusOr<StaticFiles> LoadOrInstalled(const std::string& folder,
                                                     const std::string& program);

  // "/" is index.html. Null: there is none.
  const StaticFile* Find(const std::string& path) const;
  bool empty() const { return files_.empty(); }

 private:
  std::map<std::string, StaticFile> files_;  // by path, "/assets/console.js"
};

}  // namespace plumescout::server
