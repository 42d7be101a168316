// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumescout::server {

extern const char* const kVersion;  // of the project, as its build says: "1.2.3"

}  // namespace plumescout::server
