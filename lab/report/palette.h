// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "lab/report/image.h"

namespace plumescout::lab {

// Paper and ink.
inline constexpr Rgb kPaper{255, 255, 255};
inline constexpr Rgb kInk{31, 36, 48};
inline constexpr Rgb kFaintInk{107, 114, 128};
inline constexpr Rgb kGridLine{226, 229, 234};
inline constexpr Rgb kFrame{150, 156, 168};

// The map.
inline constexpr Rgb kUnknownColor{222, 225, 230};
inline constexpr Rgb kFreeColor{255, 255, 255};
inline constexpr Rgb kOccupiedColor{52, 58, 70};
inline constexpr Rgb kWallColor{142, 148, 160};  // occupied, where cells show a field
inline constexpr Rgb kOccupancyFrontierColor{226, 54, 54};
inline constexpr Rgb kGasFrontierColor{247, 197, 30};
inline constexpr Rgb kRandomGoalColor{130, 136, 148};
inline constexpr Rgb kSourceColor{206, 30, 140};
inline constexpr Rgb kStartColor{22, 150, 84};

// How an objective stands; told apart also by the colour-blind.
inline constexpr Rgb kJudgedBelowColor{159, 205, 234};
inline constexpr Rgb kJudgedAboveColor{230, 159, 0};
inline constexpr Rgb kJudgedRefutedColor{192, 57, 43};
inline constexpr Rgb kJudgedUndecidedColor{245, 234, 124};
inline constexpr Rgb kNotMeasuredColor{201, 201, 201};

// Paths and curves, told apart also by the colour-blind.
inline constexpr std::array<Rgb, 6> kLineColors = {
    {{36, 99, 201}, {222, 120, 20}, {20, 140, 140}, {142, 68, 173}, {120, 85, 40}, {90, 96, 110}}};

// Robots of a team, the first as kLineColors has it.
inline constexpr std::array<Rgb, 8> kTeamColors = {{{36, 99, 201},
                                                    {222, 120, 20},
                                                    {20, 140, 90},
                                                    {142, 68, 173},
                                                    {206, 30, 60},
                                                    {20, 160, 190},
                                                    {150, 130, 20},
                                                    {225, 90, 170}}};

}  // namespace plumescout::lab
