// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumescout::server {

// Every option with its default and what it means: the comments of the configuration's messages.
std::string OptionHelp();

}  // namespace plumescout::server
