// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Constants_h
#define po_Constants_h

namespace po
{
inline constexpr double Pi = 3.14159265358979323846;
}

#endif
