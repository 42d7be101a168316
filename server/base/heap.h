// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumescout::server {

// From now on blocks of 1 MiB and more go back to the system when they are freed. Without this the
// GNU C library raises that limit to 32 MiB as such blocks are freed, and every thread then keeps
// what it had for the rasters of a large map. Smaller ones, such as those of a building of 16 x 20
// m, stay with the process, for to get them anew takes longer than to fill them.
void ReturnLargeBlocks();

// Has threads share an arena for each core, but two at least, unless the environment says how many
// (MALLOC_ARENA_MAX, or glibc.malloc.arena_max in GLIBC_TUNABLES). The GNU C library would make
// eight for each core, and what is freed in one stays with the process for threads of that one. Has
// no effect once a second thread has allocated anything.
void LimitArenas();

}  // namespace plumescout::server
