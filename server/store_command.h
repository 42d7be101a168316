// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>

namespace plumescout::server {

// "plumescout-server store list" and "store verify": looks at what a server has kept while none
// runs on it. Changes nothing.
//
// `argv[0]` is the name of the program, followed by what comes after "store". Tables and JSON go to
// `out`, progress and errors to `err`. Returns the exit code: 0; 1 if something is damaged or
// cannot be read; 2 if the command line is wrong.
int RunStoreCommand(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace plumescout::server
