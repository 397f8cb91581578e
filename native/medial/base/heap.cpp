// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/heap.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace medial {

void release_heap() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace medial
