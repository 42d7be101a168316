// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumescout::server {

// The calling thread, and no other, has a tenth of the CPU from then on where others want it, and
// all of it where they do not. For good: a process may not raise its threads' priority again.
void YieldCpuToOthers();

}  // namespace plumescout::server
