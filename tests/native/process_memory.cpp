// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_memory.h"

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
#elif defined(__APPLE__)
#include <mach/mach.h>
#else
#include <unistd.h>

#include <fstream>
#endif

namespace medial::test {

#ifdef _WIN32

size_t process_memory() {
  size_t committed = 0;
  MEMORY_BASIC_INFORMATION range{};
  for (const char* at = nullptr; VirtualQuery(at, &range, sizeof range) != 0;
       at = static_cast<const char*>(range.BaseAddress) + range.RegionSize) {
    if (range.State == MEM_COMMIT && range.Type == MEM_PRIVATE) committed += range.RegionSize;
  }
  return committed;
}

#elif defined(__APPLE__)

size_t process_memory() {
  mach_task_basic_info info{};
  mach_msg_type_number_t count = MACH_TASK_BASIC_INFO_COUNT;
  task_info(mach_task_self(), MACH_TASK_BASIC_INFO, reinterpret_cast<task_info_t>(&info), &count);
  return info.resident_size;
}

#else

size_t process_memory() {
  size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<size_t>(sysconf(_SC_PAGESIZE));
}

#endif

}  // namespace medial::test
