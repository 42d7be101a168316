// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

struct ddsi_serdata;
struct ddsi_sertype;

namespace plumescout::client {

// A type of DDS of which Cyclone DDS knows the name only: a sample is its bytes, a std::string with
// the encapsulation. Freed by its last topic.
ddsi_sertype* NewOpaqueType(const std::string& dds_name);

// The bytes of a sample of such a type; as long as it lives.
const std::string& BytesOf(const ddsi_serdata& sample);

}  // namespace plumescout::client
