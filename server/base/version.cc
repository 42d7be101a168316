// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/version.h"

namespace plumescout::server {

const char* const kVersion = PLUMESCOUT_VERSION;

}  // namespace plumescout::server
