#include "core/base/hold.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>

#include "core/base/error.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// In the order of the enumeration.
constexpr std::array<std::string_view, 16> names{"packing",
                                                 "step",
                                                 "crack",
                                                 "row",
                                                 "frame",
                                                 "run",
                                                 "results-claimed",
                                                 "results-filled",
                                                 "results-flushed",
                                                 "results-linked",
                                                 "checkpoint-begun",
                                                 "checkpoint-filled",
                                                 "checkpoint-sealed",
                                                 "checkpoint-between",
                                                 "checkpoint",
                                                 "measurement"};
static_assert(names.size() == static_cast<std::size_t>(HoldPoint::measurement) + 1);

/// No longer than this, should whoever set the hold be gone.
constexpr std::chrono::minutes patience{10};

struct Hold {
  HoldPoint point{};
  std::size_t count = 0;  ///< of arrivals at which to wait
  fs::path file;
  bool (*stop)() = nullptr;
  std::atomic<std::size_t> arrived = 0;
} hold;

void write_process_id(const fs::path& file) {
  fs::path aside = file;
  aside += ".part";
  if (!(std::ofstream(aside) << ::getpid() << '\n').flush())
    fail<WriteError>("BRECCIA_HOLD: {}: cannot be written", aside.string());
  fs::rename(aside, file);  // whoever sees it finds the number in it
}

}  // namespace

void set_hold(const char* text, bool (*stop)()) {
  detail::hold_is_set = false;
  const std::string_view value = text ? text : "";
  if (value.empty()) return;
  const std::size_t colon = value.find(':'), equals = value.find('=');
  const auto refuse = [&] {
    fail<BadInput>("BRECCIA_HOLD: \"{}\" is not POINT:COUNT=FILE with a point of core/base/hold.hpp", value);
  };
  if (colon == value.npos || equals == value.npos || equals < colon || equals + 1 == value.size()) refuse();
  std::size_t point = 0;
  while (point < names.size() && names[point] != value.substr(0, colon)) ++point;
  const char* const end = value.data() + equals;
  const auto [read, error] = std::from_chars(value.data() + colon + 1, end, hold.count);
  if (point == names.size() || error != std::errc() || read != end || hold.count == 0) refuse();
  hold.point = static_cast<HoldPoint>(point);
  hold.file = value.substr(equals + 1);
  hold.stop = stop;
  hold.arrived = 0;
  detail::hold_is_set = true;
}

namespace detail {

bool hold_is_set = false;

void arrive(HoldPoint point, std::size_t count) {
  if (point != hold.point) return;
  const std::size_t before = hold.arrived.fetch_add(count);
  if (before >= hold.count || before + count < hold.count) return;
  write_process_id(hold.file);
  const auto end = std::chrono::steady_clock::now() + patience;
  std::error_code ignored;
  while (fs::exists(hold.file, ignored) && !hold.stop() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

}  // namespace detail
}  // namespace breccia
