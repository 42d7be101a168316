// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "lab/sim/layout.h"

namespace plumescout::lab {

// REQUIRES: 10 <= lowest sizes <= largest sizes <= 60; 1 <= max_sources <= 8.
struct GeneratorOptions {
  int min_size_m = 10;  // of both sides
  int max_size_x_m = 20;
  int max_size_y_m = 24;
  int max_sources = 4;
};

// A building drawn at random: offices along corridors, halls with containers or rows of shelves,
// workshops, with doors, air inlets and outlets, gas leaks and a start. It rasterizes, its free
// cells are one space for a robot that keeps 0.2 m off the walls, every leak lies in the open, air
// enters far from where it leaves, and the start lies where it enters, in a room without a leak.
// Rates and speeds as in [XIT] Table I. The same arguments give the same layout on every machine.
// Cost: some milliseconds.
Layout GenerateLayout(std::uint64_t seed, const GeneratorOptions& options = {});

}  // namespace plumescout::lab
