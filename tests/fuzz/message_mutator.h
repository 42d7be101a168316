// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/message.h>

#include "core/types/rng.h"

namespace plumescout::fuzz {

// Changes one field somewhere in the message: sets it to a value that is likely to be mistaken,
// clears it, or adds, repeats, swaps or removes elements of a list.
void MutateMessage(google::protobuf::Message& message, Rng& rng);

}  // namespace plumescout::fuzz
