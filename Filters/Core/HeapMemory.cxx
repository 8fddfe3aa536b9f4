// SPDX-License-Identifier: BSD-3-Clause
#include "HeapMemory.h"

#include <cstdlib> // defines __GLIBC__

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace po
{
void returnFreeMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}
}
