// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumescout::lab {

// What this process has in memory, at most since the last ResetPeak_mb, MB.
double PeakMemory_mb();
// The same now, with what was freed given back; from here on that is the peak.
double ResetPeak_mb();

}  // namespace plumescout::lab
