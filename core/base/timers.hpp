// Where the time goes: each verb of the step is timed by name.
#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

namespace breccia {

enum class Phase {
  search,
  confinement,
  halo,
  bonds,
  gather,
  contacts,
  platens,
  ledger,
  integrate,
  measure,
  output,
  checkpoint,
  count
};

inline constexpr std::array<std::string_view, static_cast<std::size_t>(Phase::count)> phase_names{
    "search",  "confinement", "halo",      "bonds",   "gather", "contacts",
    "platens", "ledger",      "integrate", "measure", "output", "checkpoint"};

struct Phases {
  std::array<double, static_cast<std::size_t>(Phase::count)> seconds{};

  double& operator[](Phase p) { return seconds[static_cast<std::size_t>(p)]; }
  double operator[](Phase p) const { return seconds[static_cast<std::size_t>(p)]; }
  double total() const {
    double sum = 0.0;
    for (const double s : seconds) sum += s;
    return sum;
  }
};

/// Adds the time until the end of its scope to a phase.
class Lap {
public:
  Lap(Phases& phases, Phase phase) : seconds_(phases[phase]), start_(std::chrono::steady_clock::now()) {}
  ~Lap() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Lap(const Lap&) = delete;
  Lap& operator=(const Lap&) = delete;

private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace breccia
