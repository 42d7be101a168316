// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/report/cairo_handles.h"
#include "lab/report/image.h"

namespace plumescout::lab {

// Pictures as Cairo has them. REQUIRES: pixels.
CairoSurface ToCairo(const Image& image);
// REQUIRES: a surface of CAIRO_FORMAT_RGB24, nothing drawn but what is flushed.
Image FromCairo(cairo_surface_t* surface);

}  // namespace plumescout::lab
