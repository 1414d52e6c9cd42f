#include "drivers/programs/machine.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string_view>

#include "drivers/programs/command_line.hpp"
#include "io/text/text_file.hpp"
#include "kernels/math/instruction_set.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// The first line of a file that begins with `key`, less the key, blanks and a colon; empty without
/// one.
std::string line_of(const fs::path& file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t colon = line.find(':');
    return std::string(trim(std::string_view(line).substr(colon == std::string::npos ? 0 : colon + 1)));
  }
  return "";
}

/// "32K", "1024K", "8M"
std::size_t bytes_of(const std::string& size) {
  std::size_t end = 0;
  const std::size_t number = size.empty() ? 0 : std::stoul(size, &end);
  const char unit = end < size.size() ? size[end] : ' ';
  return number << (unit == 'K' ? 10 : unit == 'M' ? 20 : 0);
}

std::vector<Cache> caches() {
  std::vector<Cache> found;
  for (int k = 0;; ++k) {
    const fs::path folder = fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}", k);
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) return found;
    const std::string level = line_of(folder / "level", "");
    found.push_back({level.empty() ? 0 : std::stoi(level), line_of(folder / "type", ""),
                     bytes_of(line_of(folder / "size", "")), line_of(folder / "shared_cpu_list", "")});
  }
}

std::string compiler() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

}  // namespace

Machine describe_machine() {
  Machine m;
  m.cpu = line_of("/proc/cpuinfo", "model name");
  if (m.cpu.empty()) m.cpu = "unknown";
  m.cores = available_cores();
  m.cores_online = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  m.caches = caches();
  const std::string memory = line_of("/proc/meminfo", "MemTotal");  // "16384 kB"
  if (!memory.empty()) m.memory_bytes = std::stoul(memory) * 1024;
  std::ifstream("/proc/loadavg") >> m.load_average;
  m.compiler = compiler();
  m.instruction_set = name_of(best_instruction_set());
  m.version = BRECCIA_VERSION;
  return m;
}

}  // namespace breccia
