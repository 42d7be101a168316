// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/strings/string_view.h"
#include "lab/report/canvas.h"

namespace plumescout::lab {

// Lines that write `utf8` from the origin to the right, on the base line y = 0 (upwards is
// negative, as on a canvas). The font knows printable ASCII and the signs ±, ² and –; any
// other character is a small box. Cost: O(characters).
std::vector<std::vector<PixelPoint>> WriteText(absl::string_view utf8, double size_px);

// Length of the base line under the text.
double TextWidth_px(absl::string_view utf8, double size_px);

// The text in lines that are no wider, broken at spaces; a longer word has a line of its own.
std::vector<std::string> WrapText(absl::string_view utf8, double size_px, double width_px);

}  // namespace plumescout::lab
