// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ingest_messages.h"

#include "proto/convert/names.h"

namespace plumescout::client {

IngestState StateFromProto(const v1::IngestState& proto) {
  return {.applied_sequence = proto.applied_sequence(),
          .durable_sequence = proto.durable_sequence(),
          .credit_sequence = proto.credit_sequence(),
          .revision = proto.revision()};
}

v1::OpenIngest OpeningOf(const RobotSession& session) {
  v1::OpenIngest open;
  open.set_robot(RobotResource({session.mission, session.robot}));
  open.set_lease_token(session.lease_token);
  open.set_durable_sequence(session.durable_sequence);
  return open;
}

}  // namespace plumescout::client
