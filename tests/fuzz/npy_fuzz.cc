// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Arrays of NumPy.

#include <cstdint>

#include "lab/formats/npy.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const plumescout::fuzz::MemoryFile file({reinterpret_cast<const char*>(data), size});
  plumescout::lab::ReadNpy(file.path()).status().IgnoreError();
  return 0;
}
