// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PLUMESCOUT_UNDER_SANITIZER true
#endif
#endif
#ifndef PLUMESCOUT_UNDER_SANITIZER
#define PLUMESCOUT_UNDER_SANITIZER false
#endif

namespace plumescout::support {

inline constexpr bool kUnderSanitizer = PLUMESCOUT_UNDER_SANITIZER;

// How often a test repeats what differs by its random numbers alone. Under sanitizers, which take
// ten times as long and look at how memory is used rather than at what comes out, a quarter does.
constexpr int Rounds(int count) { return kUnderSanitizer ? (count + 3) / 4 : count; }

}  // namespace plumescout::support
