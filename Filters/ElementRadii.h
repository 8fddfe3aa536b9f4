// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ElementRadii_h
#define po_ElementRadii_h

#include "ParticleOcclusionFiltersModule.h"

#include <string_view>

namespace po
{
/// Atomic number of a chemical symbol, in any case, with whatever follows its letters left out
/// ("Fe3+", "C12", "fe"); blanks around it do not matter. 0 for what is no element.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT int atomicNumberOf(std::string_view symbol);

/// Van der Waals radius in ångström: A. Bondi, J. Phys. Chem. 68 (1964) 441; where Bondi has none,
/// M. Mantina et al., J. Phys. Chem. A 113 (2009) 5806, for the main groups, and 2 for the elements
/// that neither has (most transition metals), as crystallographers do. NaN where there is no such
/// element.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT double vanDerWaalsRadius(int atomicNumber);
}

#endif
