// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteRims_h
#define po_SilhouetteRims_h

#include "SilhouetteFinder.h"
#include "SphereDepth.h"

namespace po
{
/// Silhouettes of traced spheres.
///
/// With one sample a pixel they are those of findSilhouettes() from the same depths, bit for bit.
///
/// With more, edges are found between pixels, and each line is drawn where the rim of the sphere in
/// front of it truly is: the strength of a pixel is the share of its area between the rim and the
/// line's width beyond it. No ray is traced for that: the distance of an edge from the rim follows
/// from the sphere, as (h - r) / |grad h| with h the distance of its centre from the pixel's ray,
/// and so does the circle that touches the rim there, from which pixels around the edge have their
/// distances. Within a pixel the rim is taken as straight. It is what infinitely many samples would
/// give, as long as particles are larger than a pixel; the number of samples does not matter.
/// Strengths are multiples of 1 / 16383, shares within rims of 1 / 255.
SilhouetteCounters findTracedSilhouettes(const SphereDepth& depth, const SilhouetteRule& rule,
  SilhouetteImage& image, const SilhouetteOptions& options = {});
}

#endif
