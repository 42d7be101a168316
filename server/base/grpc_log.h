// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumescout::server {

// From now on what gRPC itself has to say goes into our log. By itself it writes to stderr from any
// of its threads, and would wait there for who reads it.
void TakeGrpcLog();

}  // namespace plumescout::server
