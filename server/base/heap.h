// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumescout::server {

// From now on blocks of 1 MiB and more go back to the system when they are freed. Without this the
// GNU C library raises that limit to 32 MiB as such blocks are freed, and every thread then keeps
// what it had for the rasters of a large map. Smaller ones, such as those of a building of 16 x 20
// m, stay with the process, for to get them anew takes longer than to fill them.
void ReturnLargeBlocks();

}  // namespace plumescout::server
