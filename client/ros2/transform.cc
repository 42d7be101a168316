// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/transform.h"

#include <cmath>

namespace plumescout::client {
namespace {

using ros::Quaternion;
using ros::Vector3;

// A rotation's quaternion is written with five digits at least.
constexpr double kNoRotation = 0.1;
// Below this angle between quaternions the straight line is as good as the arc.
constexpr double kNearlySame = 1.0 - 1e-9;

Quaternion Times(const Quaternion& a, const Quaternion& b) {
  return {
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

Quaternion Conjugate(const Quaternion& q) { return {-q.x, -q.y, -q.z, q.w}; }

Vector3 Rotate(const Quaternion& q, const Vector3& v) {
  const Quaternion turned = Times(Times(q, {v.x, v.y, v.z, 0.0}), Conjugate(q));
  return {turned.x, turned.y, turned.z};
}

Quaternion Mix(const Quaternion& a, double of_a, const Quaternion& b, double of_b) {
  return {of_a * a.x + of_b * b.x, of_a * a.y + of_b * b.y, of_a * a.z + of_b * b.z,
          of_a * a.w + of_b * b.w};
}

double Dot(const Quaternion& a, const Quaternion& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

}  // namespace

Transform Compose(const Transform& a, const Transform& b) {
  const Vector3 turned = Rotate(a.orientation, b.position);
  return {.position = {a.position.x + turned.x, a.position.y + turned.y, a.position.z + turned.z},
          .orientation = Times(a.orientation, b.orientation)};
}

Transform Inverse(const Transform& a) {
  const Quaternion back = Conjugate(a.orientation);
  const Vector3 turned = Rotate(back, a.position);
  return {.position = {-turned.x, -turned.y, -turned.z}, .orientation = back};
}

Transform Interpolate(const Transform& a, const Transform& b, double share) {
  const double rest = 1.0 - share;
  Transform mixed;
  mixed.position = {rest * a.position.x + share * b.position.x,
                    rest * a.position.y + share * b.position.y,
                    rest * a.position.z + share * b.position.z};
  const double dot = Dot(a.orientation, b.orientation);
  const double sign = dot < 0.0 ? -1.0 : 1.0;
  double of_a = rest;
  double of_b = share;
  if (std::abs(dot) < kNearlySame) {
    const double angle_rad = std::acos(std::abs(dot));
    of_a = std::sin(rest * angle_rad) / std::sin(angle_rad);
    of_b = std::sin(share * angle_rad) / std::sin(angle_rad);
  }
  mixed.orientation = Mix(a.orientation, of_a, b.orientation, sign * of_b);
  return mixed;
}

std::optional<Transform> Normalise(const Transform& transform) {
  const Quaternion& q = transform.orientation;
  const double length = std::sqrt(Dot(q, q));
  const Vector3& p = transform.position;
  if (!std::isfinite(p.x + p.y + p.z) || !std::isfinite(length) || length < kNoRotation) {
    return std::nullopt;
  }
  return Transform{.position = p,
                   .orientation = {q.x / length, q.y / length, q.z / length, q.w / length}};
}

Transform FromPlanar(const Pose2& pose) {
  return {.position = {pose.x_m, pose.y_m, 0.0},
          .orientation = {0.0, 0.0, std::sin(pose.yaw_rad / 2.0), std::cos(pose.yaw_rad / 2.0)}};
}

Pose2 ToPlanar(const Transform& transform) {
  const Vector3 ahead = Rotate(transform.orientation, {1.0, 0.0, 0.0});
  return {transform.position.x, transform.position.y, WrapAngle_rad(std::atan2(ahead.y, ahead.x))};
}

double Upright(const Transform& transform) {
  return Rotate(transform.orientation, {0.0, 0.0, 1.0}).z;
}

}  // namespace plumescout::client
