#include "io/machine_json.hpp"

namespace breccia {

nlohmann::ordered_json json_of(const Machine& m) {
  nlohmann::ordered_json caches = nlohmann::ordered_json::array();
  for (const Cache& c : m.caches)
    caches.push_back({{"level", c.level}, {"type", c.type}, {"bytes", c.bytes}, {"shared_by", c.shared_by}});
  return {{"cpu", m.cpu},
          {"cores", m.cores},
          {"cores_online", m.cores_online},
          {"caches", caches},
          {"memory_bytes", m.memory_bytes},
          {"load_average", m.load_average},
          {"compiler", m.compiler},
          {"instruction_set", m.instruction_set}};
}

}  // namespace breccia
