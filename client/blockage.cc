// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/blockage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plumescout::client {
namespace {

double DistanceToSegment_m(Point2 point, Point2 a, Point2 b) {
  const double dx_m = b.x_m - a.x_m;
  const double dy_m = b.y_m - a.y_m;
  const double length_m2 = dx_m * dx_m + dy_m * dy_m;
  const double along_m2 = (point.x_m - a.x_m) * dx_m + (point.y_m - a.y_m) * dy_m;
  const double share = length_m2 > 0.0 ? std::clamp(along_m2 / length_m2, 0.0, 1.0) : 0.0;
  return Distance_m(point, {a.x_m + share * dx_m, a.y_m + share * dy_m});
}

// The first `length_m` of a polyline.
std::vector<Point2> Head(const std::vector<Point2>& path, double length_m) {
  std::vector<Point2> head;
  for (const Point2 vertex : path) {
    if (!head.empty()) {
      const double segment_m = Distance_m(head.back(), vertex);
      if (segment_m > length_m) {
        const double share = length_m / segment_m;
        const Point2 last = head.back();
        head.push_back({last.x_m + share * (vertex.x_m - last.x_m),
                        last.y_m + share * (vertex.y_m - last.y_m)});
        return head;
      }
      length_m -= segment_m;
    }
    head.push_back(vertex);
  }
  return head;
}

double DistanceToPath_m(Point2 point, const std::vector<Point2>& path) {
  double nearest_m = Distance_m(point, path.front());
  for (std::size_t i = 1; i < path.size(); ++i) {
    nearest_m = std::min(nearest_m, DistanceToSegment_m(point, path[i - 1], path[i]));
  }
  return nearest_m;
}

}  // namespace

bool PathBlocked(const Scan& scan, const Pose2& scan_pose, const std::vector<Point2>& path_ahead,
                 const BlockageOptions& options) {
  if (path_ahead.size() < 2) return false;
  const std::vector<Point2> head = Head(path_ahead, options.lookahead_m);
  const double clearance_m =
      std::max(options.radius_m - options.map_blur_m, options.min_clearance_m);
  const double end_clearance_m =
      head.back() == path_ahead.back() ? clearance_m + options.end_margin_m : 0.0;
  int beams = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    const bool near = range_m > 0.0 && range_m < options.lookahead_m + options.radius_m;
    if (!near) continue;  // NaN is not near either
    const double angle_rad =
        scan_pose.yaw_rad + scan.start_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
    const Point2 end = {scan_pose.x_m + range_m * std::cos(angle_rad),
                        scan_pose.y_m + range_m * std::sin(angle_rad)};
    const double nearer_m = Distance_m(end, head.front()) - options.range_noise_m;
    const bool in_the_way = DistanceToPath_m(end, head) < std::min(clearance_m, nearer_m) ||
                            Distance_m(end, head.back()) < std::min(end_clearance_m, nearer_m);
    if (in_the_way && ++beams >= options.min_beams) return true;
  }
  return false;
}

}  // namespace plumescout::client
