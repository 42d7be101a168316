// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "formats/recording_file.h"

namespace plumescout::support {

// Opens files as recordings do, on a disk that takes nothing more while it is `full`, which
// outlives them.
inline auto OpenOnDiskThatFills(bool& full) {
  return [&full](const std::string& path) -> absl::StatusOr<AppendBytes> {
    auto file = OpenRecordingFile(path);
    if (!file.ok()) return file.status();
    return AppendBytes([&full, append = *file](absl::string_view bytes) {
      return full ? absl::UnavailableError("No space left on device") : append(bytes);
    });
  };
}

}  // namespace plumescout::support
