// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/epoch_runner.h"

#include <utility>

#include "server/base/clock.h"

namespace plumescout::server {

void EpochRunner::Start(std::shared_ptr<GasEpochs> epoch) {
  work_.Start([epoch = std::move(epoch), metrics = metrics_] {
    const SteadyTime from = SteadyNow();
    epoch->Recompute();
    metrics->NoteEpoch(absl::FromChrono(SteadyNow() - from));
  });
}

}  // namespace plumescout::server
