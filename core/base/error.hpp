// The three ways a program ends badly; each carries one line that names the place, the cause and
// the cure.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace breccia {

/// Input that is wrong: exit code 2, nothing written.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A simulation that broke (not a number, unstable): exit code 3.
struct SimulationBroke : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A file that cannot be written: exit code 4.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class Error, class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) {
  throw Error(fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace breccia
