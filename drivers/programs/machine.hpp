// What a measurement was made on.
#pragma once
#include <string>
#include <vector>

namespace breccia {

struct Cache {
  int level = 0;
  std::string type;       ///< "Data", "Instruction", "Unified"
  std::size_t bytes = 0;  ///< of one
  std::string shared_by;  ///< logical processors that share it with the first, "0-7"
};

struct Machine {
  std::string cpu;               ///< model name; "unknown" where the system does not tell
  int cores = 0;                 ///< logical processors that this process may use
  int cores_online = 0;          ///< that the machine has
  std::vector<Cache> caches;     ///< of the first processor
  std::size_t memory_bytes = 0;  ///< 0 where the system does not tell
  double load_average = 0;       ///< processes running or waiting, mean of the last minute
  std::string compiler;          ///< name and version
  std::string instruction_set;   ///< of the wide loops
  std::string version;           ///< of breccia
};

/// Reads /proc and /sys; what they do not tell is left as it is.
Machine describe_machine();

}  // namespace breccia
