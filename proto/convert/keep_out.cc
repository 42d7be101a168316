// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/keep_out.h"

#include <string>
#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"

namespace plumescout {

absl::StatusOr<std::vector<Polygon>> FromProto(const PolygonsProto& proto,
                                               absl::string_view field) {
  std::vector<Polygon> areas;
  for (int i = 0; i < proto.size(); ++i) {
    const std::string area = Join("", field, i);
    Polygon polygon;
    polygon.name = proto[i].name();
    for (int k = 0; k < proto[i].vertices_size(); ++k) {
      PLUMESCOUT_ASSIGN_OR_RETURN(const Point2 vertex,
                                  FromProto(proto[i].vertices(k), Join(area, "vertices", k)));
      polygon.vertices.push_back(vertex);
    }
    areas.push_back(std::move(polygon));
  }
  return areas;
}

PolygonsProto ToProto(const std::vector<Polygon>& areas) {
  PolygonsProto proto;
  for (const Polygon& area : areas) {
    v1::Polygon& added = *proto.Add();
    added.set_name(area.name);
    for (const Point2 vertex : area.vertices) *added.add_vertices() = ToProto(vertex);
  }
  return proto;
}

absl::StatusOr<KeepOutChanged> FromProto(const v1::ChangeKeepOutAreasRequest& request) {
  KeepOutChanged change;
  change.deleted.assign(request.deleted().begin(), request.deleted().end());
  PLUMESCOUT_ASSIGN_OR_RETURN(change.added, FromProto(request.added(), "added"));
  return change;
}

v1::ChangeKeepOutAreasRequest ToProto(const KeepOutChanged& change) {
  v1::ChangeKeepOutAreasRequest request;
  *request.mutable_deleted() = {change.deleted.begin(), change.deleted.end()};
  *request.mutable_added() = ToProto(change.added);
  return request;
}

}  // namespace plumescout
