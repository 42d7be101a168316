// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/types/pose2.h"
#include "formats/ros/messages.h"

namespace plumescout::client {

// Where frame b lies in frame a, as ROS writes it: `orientation` is of length 1.
using Transform = ros::Pose;

// Where b lies in a, of b's own frame where c lies: where c lies in a.
Transform Compose(const Transform& a, const Transform& b);
Transform Inverse(const Transform& a);
// On the straight line and the shorter turn between them; share 0: a, 1: b.
Transform Interpolate(const Transform& a, const Transform& b, double share);

// Of length 1, whatever it was; nothing if it is not finite or no rotation.
std::optional<Transform> Normalise(const Transform& transform);

Transform FromPlanar(const Pose2& pose);
// What is seen of it from above.
Pose2 ToPlanar(const Transform& transform);
// How much of its z axis points up: 1 level, -1 upside down.
double Upright(const Transform& transform);

}  // namespace plumescout::client
