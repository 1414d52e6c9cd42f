#include "core/base/process_memory.hpp"

#include <malloc.h>

#include <fstream>
#include <string>

namespace breccia {

void reset_peak_memory() {
  malloc_trim(0);                               // what the one before has freed would count for the next
  std::ofstream("/proc/self/clear_refs") << 5;  // proc(5): the peak of the resident set begins anew
}

std::size_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoul(line.substr(6)) * 1024;  // kB
  return 0;
}

}  // namespace breccia
