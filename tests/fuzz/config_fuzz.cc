// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Configuration files of the server.

#include <cstdint>
#include <string>

#include "server/config/config_convert.h"
#include "server/config/config_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumescout::server::ConfigBuilder builder;
  const std::string yaml(reinterpret_cast<const char*>(data), size);
  if (!builder.AddYaml(yaml, "fuzz.yaml").ok()) return 0;
  const auto config = builder.Build();
  // What is valid stays so.
  if (config.ok() &&
      !plumescout::server::ServerConfigFromProto(plumescout::server::ServerConfigToProto(*config))
           .ok()) {
    __builtin_trap();
  }
  return 0;
}
