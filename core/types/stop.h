// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace plumescout {

// Asked now and then by long computations; true means: return what you have, soon. What has said so
// goes on saying so.
// Carries an RPC's deadline and cancellation into the core, which has no clock.
using StopFn = std::function<bool()>;

inline StopFn NeverStop() {
  return [] { return false; };
}

// Whether `stop` says so; an empty one never does.
inline bool Stops(const StopFn& stop) { return stop && stop(); }

}  // namespace plumescout
