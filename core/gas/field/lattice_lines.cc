// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/lattice_lines.h"

#include <algorithm>

namespace plumescout {
namespace {

// Active cells beside ones that are not, which lines along walls are full of.
std::vector<LatticeCell> WallEdges(std::size_t width, std::size_t height,
                                   std::span<const std::uint8_t> active) {
  std::vector<LatticeCell> edges;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t cell = y * width + x;
      if (active[cell] == 0) continue;
      const bool east = x + 1 < width && active[cell + 1] == 0;
      const bool north = y + 1 < height && active[cell + width] == 0;
      const bool west = x > 0 && active[cell - 1] == 0;
      const bool south = y > 0 && active[cell - width] == 0;
      if (!(east || north || west || south)) continue;
      edges.push_back({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)});
    }
  }
  return edges;
}

// Looks for the slope by which projections of the edges are least even, as the lines of a page that
// is held straight.
class SlopeSearch {
 public:
  SlopeSearch(std::size_t width, std::size_t height, const std::vector<LatticeCell>& edges)
      : width_(width), height_(height) {
    // Far from each other: those side by side are mostly of one band, and to count one they would
    // wait for the other.
    constexpr std::size_t kStride = 64;
    edges_.reserve(edges.size());
    for (std::size_t first = 0; first < kStride; ++first) {
      for (std::size_t i = first; i < edges.size(); i += kStride) edges_.push_back(edges[i]);
    }
  }

  // The best slope in [low, high], by steps that move the far end of a line by a band of 2^`bits`
  // cells; lines are taken together by as many.
  double Best(double low, double high, int bits) {
    const double band = 1 << bits;
    const double step = band / static_cast<double>(std::max(width_, height_));
    double best_slope = low;
    double best = 0.0;
    for (double slope = low; slope <= high; slope += step) {
      const double crowding = Crowding(slope, bits);
      if (crowding > best) {
        best = crowding;
        best_slope = slope;
      }
    }
    return best_slope;
  }

  // Mean square of edges per band over the square of the mean: 1 if they are even.
  double Crowding(double slope, int bits) {
    double sum = 0.0;
    for (const auto across : {LatticeLines::Across::kX, LatticeLines::Across::kY}) {
      const LatticeLines lines(across, slope, width_, height_);
      bands_.assign((lines.count() >> bits) + 1, 0);
      for (const LatticeCell cell : edges_) {
        ++bands_[static_cast<std::size_t>(lines.line(cell) >> bits)];
      }
      double squares = 0.0;
      for (const std::int32_t count : bands_) squares += static_cast<double>(count) * count;
      sum += squares * static_cast<double>(bands_.size());
    }
    return sum / (2.0 * static_cast<double>(edges_.size()) * static_cast<double>(edges_.size()));
  }

 private:
  std::size_t width_;
  std::size_t height_;
  std::vector<LatticeCell> edges_;
  std::vector<std::int32_t> bands_;
};

}  // namespace

LatticeLines::LatticeLines(Across across, double slope, std::size_t width, std::size_t height)
    : across_(across) {
  const double along = across == Across::kX ? slope : -slope;
  const std::size_t length = across == Across::kX ? height : width;
  const std::size_t breadth = across == Across::kX ? width : height;
  // The least shift is 0.
  const double start = along < 0.0 ? -along * static_cast<double>(length - 1) : 0.0;
  shift_.reserve(length);
  for (std::size_t i = 0; i < length; ++i) {
    const double shift = start + along * static_cast<double>(i) + 0.5;  // > 0: a cast rounds down
    shift_.push_back(static_cast<std::int32_t>(shift));
  }
  count_ = breadth + static_cast<std::size_t>(std::max(shift_.front(), shift_.back()));
}

double WallSlope(std::size_t width, std::size_t height, std::span<const std::uint8_t> active) {
  constexpr double kStandsOut = 1.2;  // from the axes, as a factor of the crowding
  constexpr int kCoarse_bits = 2;
  const std::vector<LatticeCell> edges = WallEdges(width, height, active);
  if (edges.empty()) return 0.0;
  SlopeSearch search(width, height, edges);
  const double coarse = search.Best(-1.0, 1.0, kCoarse_bits);
  const double step = (1 << kCoarse_bits) / static_cast<double>(std::max(width, height));
  const double fine = search.Best(std::max(-1.0, coarse - step), std::min(1.0, coarse + step), 0);
  return search.Crowding(fine, 0) > kStandsOut * search.Crowding(0.0, 0) ? fine : 0.0;
}

}  // namespace plumescout
