// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/momentum.h"

#include <algorithm>
#include <cmath>

namespace plumescout::lab {
namespace {

// Speed half way between `upwind` and `downwind`; `far` lies beyond `upwind`. Van Leer's limiter,
// half of psi(r) (downwind - upwind) with psi = 2 r / (1 + r), written out.
double Interpolated(double far, double upwind, double downwind) {
  const double before = upwind - far;
  const double after = downwind - upwind;
  const double product = before * after;
  return product > 0.0 ? upwind + product / (before + after) : upwind;
}

Side EdgeSide(Cell step) {
  if (step.x != 0) return step.x < 0 ? Side::kWest : Side::kEast;
  return step.y < 0 ? Side::kSouth : Side::kNorth;
}

}  // namespace

// Lists links and ghosts, once.
class Momentum::Builder {
 public:
  Builder(const FlowDomain& domain, const FreeFaces& free, Momentum& momentum)
      : domain_(domain), free_(free), momentum_(momentum), field_(domain.fluid.geometry()) {}

  void Build() {
    for (const Face& face : free_.all()) {
      momentum_.moving_.push_back(Index(face));
      for (const Axis axis : {Axis::kX, Axis::kY}) {
        AddLink(face, axis, Unit(axis));
        AddLink(face, axis, Minus({}, Unit(axis)));
      }
    }
    for (const BoundaryFace& opening : domain_.openings) {
      if (opening.inflow_mps) continue;
      const OpeningFaces faces = FacesOf(opening);
      momentum_.moving_.push_back(Index(faces.outer));
      momentum_.outlets_.push_back({Index(faces.outer), Index(faces.inner), faces.inward});
    }
    momentum_.speeds_.resize(field_.values().size() + momentum_.ghosts_.size());
    momentum_.rates_.resize(momentum_.speeds_.size());
  }

 private:
  // Neighbour of a face: a face itself, or a ghost.
  struct Neighbour {
    std::uint32_t index;
    bool is_free;
    Face face;  // if is_free
  };

  std::uint32_t Index(const Face& face) const {
    return static_cast<std::uint32_t>(IndexOf(face, field_));
  }
  bool IsFluid(Cell cell) const { return domain_.fluid.At(cell, 0) != 0; }

  // The side of `face` in direction `step`, unless its neighbour there lists it.
  void AddLink(const Face& face, Axis axis, Cell step) {
    const Neighbour near = Next(face, step);
    const bool onward = step == Unit(axis);
    if (near.is_free && !onward) return;
    const std::uint32_t here = Index(face);
    const std::uint32_t far = near.is_free ? Next(near.face, step).index : near.index;
    const std::uint32_t back = Next(face, Minus({}, step)).index;
    Link link =
        onward ? Link{back, here, near.index, far, 0, 0} : Link{far, near.index, here, back, 0, 0};
    if (axis == face.axis) {
      link.carrier_a = here;
      link.carrier_b = near.index;
    } else {
      const Cell shift = onward ? step : Cell{0, 0};
      link.carrier_a = Index({Plus(face.behind(), shift), axis});
      link.carrier_b = Index({Plus(face.ahead, shift), axis});
    }
    momentum_.links_.push_back(link);
  }

  // Along its own axis a free face always has neighbours on the raster.
  Neighbour Next(const Face& face, Cell step) {
    const Face next{Plus(face.ahead, step), face.axis};
    const bool along = (step.x != 0) == (face.axis == Axis::kX);
    if (!along && !domain_.fluid.Contains(next.ahead)) return EdgeGhost(face, step);
    if (!along && !IsFluid(next.ahead) && !IsFluid(next.behind())) return Wall(face, 0.0);
    return {Index(next), free_.IsFree(next), next};
  }

  Neighbour Wall(const Face& face, double speed_mps) {
    return AddGhost({Index(face), -1.0, 2.0 * speed_mps});
  }

  Neighbour EdgeGhost(const Face& face, Cell step) {
    const Side side = EdgeSide(step);
    const BoundaryFace* opening = OpeningAt(face.ahead, side);
    if (opening == nullptr || OpeningAt(face.behind(), side) == nullptr) {
      return Wall(face, domain_.edge_speeds_mps[static_cast<std::size_t>(side)]);
    }
    return AddGhost({Index(face), opening->inflow_mps ? 0.0 : 1.0, 0.0});
  }

  const BoundaryFace* OpeningAt(Cell cell, Side side) const {
    const auto found = std::find_if(
        domain_.openings.begin(), domain_.openings.end(),
        [&](const BoundaryFace& face) { return face.cell == cell && face.side == side; });
    return found == domain_.openings.end() ? nullptr : &*found;
  }

  Neighbour AddGhost(const Ghost& ghost) {
    const std::size_t index = field_.values().size() + momentum_.ghosts_.size();
    momentum_.ghosts_.push_back(ghost);
    return {static_cast<std::uint32_t>(index), false, {}};
  }

  const FlowDomain& domain_;
  const FreeFaces& free_;
  Momentum& momentum_;
  MacField field_;  // for its numbering
};

Momentum::Momentum(const FlowDomain& domain, const FreeFaces& free)
    : resolution_m_(domain.fluid.geometry().resolution_m) {
  Builder(domain, free, *this).Build();
}

void Momentum::Rate(const MacField& velocity, double viscosity_m2_per_s, std::span<double> rate) {
  const std::span<const double> faces = velocity.values();
  std::copy(faces.begin(), faces.end(), speeds_.begin());
  for (std::size_t i = 0; i < ghosts_.size(); ++i) {
    const Ghost& ghost = ghosts_[i];
    speeds_[faces.size() + i] = ghost.offset_mps + ghost.factor * speeds_[ghost.face];
  }
  std::fill(rates_.begin(), rates_.end(), 0.0);
  const double friction_mps = viscosity_m2_per_s / resolution_m_;
  const double per_m = 1.0 / resolution_m_;
  for (const Link& link : links_) {
    const double behind = speeds_[link.behind];
    const double ahead = speeds_[link.ahead];
    const double carrier = 0.5 * (speeds_[link.carrier_a] + speeds_[link.carrier_b]);
    const double carried = carrier > 0.0 ? Interpolated(speeds_[link.far_behind], behind, ahead)
                                         : Interpolated(speeds_[link.far_ahead], ahead, behind);
    const double flux = (carrier * carried - friction_mps * (ahead - behind)) * per_m;
    rates_[link.behind] -= flux;
    rates_[link.ahead] += flux;
  }
  for (const Outlet& outlet : outlets_) {
    const double speed = speeds_[outlet.outer];
    const bool enters = speed * outlet.inward > 0.0;
    const double change = enters ? 0.5 * speed : speed - speeds_[outlet.inner];
    rates_[outlet.outer] = -std::abs(speed) * change * per_m;
  }
  std::copy_n(rates_.begin(), rate.size(), rate.begin());
}

}  // namespace plumescout::lab
