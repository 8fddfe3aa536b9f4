// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_HeapMemory_h
#define po_HeapMemory_h

namespace po
{
/// Gives memory that was freed back to the system, where the C library would keep it for later: to
/// be called where a phase of a bake has ended whose memory the next one does not use. Does nothing
/// with other libraries than that of GNU.
void returnFreeMemory();
}

#endif
