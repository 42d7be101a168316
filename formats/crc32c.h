// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/strings/string_view.h"

namespace plumescout {

// CRC-32C (Castagnoli, reflected polynomial 0x82F63B78; RFC 3720 appendix B.4) of `bytes`. To
// continue over a second piece pass the first one's result as `crc`.
std::uint32_t Crc32c(absl::string_view bytes, std::uint32_t crc = 0);

}  // namespace plumescout
