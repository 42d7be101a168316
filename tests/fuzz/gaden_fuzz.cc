// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// GADEN's files; the first byte tells which: environments (csv), frames, wind.

#include <cstdint>

#include "formats/zlib_codec.h"
#include "lab/formats/gaden_environment.h"
#include "lab/formats/gaden_frame.h"
#include "lab/formats/gaden_wind.h"
#include "tests/fuzz/memory_file.h"

namespace {

plumescout::lab::GadenEnvironment SmallEnvironment() {
  plumescout::lab::GadenEnvironment environment;
  environment.cells = {2, 2, 1};
  environment.cell_size_m = 0.5;
  environment.states.resize(environment.size());
  return environment;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const absl::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const plumescout::fuzz::MemoryFile file(bytes);
  switch (data[0] % 3) {
    case 0:
      plumescout::lab::ReadGadenEnvironment(file.path()).status().IgnoreError();
      break;
    case 1:
      plumescout::lab::ParseGadenFrame(bytes).status().IgnoreError();
      break;
    default:
      plumescout::lab::ReadGadenWind(file.path(), SmallEnvironment(), 0).status().IgnoreError();
  }
  return 0;
}
