// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Matrix4_h
#define po_Matrix4_h

#include <array>

namespace po
{
/// 4 x 4 matrix, row-major; it acts on column vectors.
using Matrix4 = std::array<double, 16>;
}

#endif
