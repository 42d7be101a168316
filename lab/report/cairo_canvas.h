// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "lab/report/canvas.h"
#include "lab/report/image.h"

namespace plumescout::lab {

// Draws by Cairo what `draw` puts on its canvas. The same drawing gives the same bytes.
using Drawing = std::function<void(Canvas&)>;

// As a picture. With a `scale` above 1 a pixel of the canvas becomes so many of the picture's.
Image DrawImage(int width_px, int height_px, Rgb background, const Drawing& draw,
                double scale = 1.0);

// As an SVG document; letters are shapes in it, and pictures are embedded.
std::string DrawSvg(int width_px, int height_px, const Drawing& draw);

}  // namespace plumescout::lab
