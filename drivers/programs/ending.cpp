#include "drivers/programs/ending.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <mutex>
#include <new>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "core/base/error.hpp"
#include "io/text/message_line.hpp"

namespace breccia {
namespace {

constexpr const char* fewer_threads =
    "use fewer threads (--threads), or raise the limits (ulimit -u, ulimit -v)";

Ending no_memory() { return {"not enough memory: use fewer spheres", 3}; }

/// TBB says so in words only.
bool is_of_threads(std::string_view what) {
  return what.find("pthread") != std::string_view::npos || what.find("thread") != std::string_view::npos;
}

/// Of the whole program: a terminate handler takes no argument.
std::string& name_of_program() {
  static std::string name;
  return name;
}

[[noreturn]] void end_at_once() {
  const std::exception_ptr thrown = std::current_exception();
  const Ending ending = thrown ? ending_of(thrown) : Ending{"ended by an error of its own", 3};
  std::fputs((name_of_program() + ": " + message_line(ending.what) + '\n').c_str(), stderr);
  _exit(ending.code);
}

void* wait_to_go(void* gate) {
  const std::lock_guard wait(*static_cast<std::mutex*>(gate));
  return nullptr;
}

}  // namespace

Ending ending_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const BadInput& error) {
    return {error.what(), 2};
  } catch (const SimulationBroke& error) {
    return {error.what(), 3};
  } catch (const WriteError& error) {
    return {error.what(), 4};
  } catch (const std::bad_alloc&) {
    return no_memory();
  } catch (const std::length_error&) {  // more elements than a table can have
    return no_memory();
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string file = error.path1().empty() ? "a file" : error.path1().string();
    return {fmt::format("{}: {}; is the path right, and may you use it?", file, error.code().message()), 4};
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again)
      return {fmt::format("cannot start threads: {}; {}", error.code().message(), fewer_threads), 3};
    return {fmt::format("cannot read or write: {}", error.what()), 4};
  } catch (const std::exception& error) {
    if (is_of_threads(error.what()))
      return {fmt::format("cannot start threads: {}; {}", error.what(), fewer_threads), 3};
    return {fmt::format("ended by an error of its own, please report it: {}", error.what()), 3};
  } catch (...) {
    return {"ended by an error of its own, please report it", 3};
  }
}

void end_in_order(const std::string& program) {
  name_of_program() = program;
  std::set_terminate(end_at_once);
}

void try_threads(int threads) {
  constexpr std::size_t stack = std::size_t{4} << 20;  // what TBB gives a worker
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack);
  std::vector<pthread_t> started;
  std::mutex gate;
  int error = 0;
  {
    const std::lock_guard closed(gate);
    for (int k = 1; k < threads && error == 0; ++k) {
      pthread_t thread{};
      error = pthread_create(&thread, &attributes, wait_to_go, &gate);
      if (error == 0) started.push_back(thread);
    }
  }
  for (const pthread_t thread : started) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  if (error != 0)
    fail<SimulationBroke>("cannot start {} threads: {}; {}", threads, std::generic_category().message(error),
                          fewer_threads);
}

}  // namespace breccia
