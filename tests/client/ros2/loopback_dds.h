// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>
#include <unistd.h>

namespace plumescout::client {

// Has Cyclone DDS keep to loopback, without multicast. To be called before anything of DDS.
inline void KeepDdsToLoopback() {
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\"/>"
         "</Interfaces><AllowMulticast>false</AllowMulticast></General><Discovery>"
         "<ParticipantIndex>auto</ParticipantIndex>"
         "<MaxAutoParticipantIndex>30</MaxAutoParticipantIndex>"
         "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>",
         /*overwrite=*/1);
}

// Where no other test is.
inline int OwnDomain() { return 100 + getpid() % 100; }

}  // namespace plumescout::client
