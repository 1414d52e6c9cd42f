#include "drivers/programs/signals.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace breccia {
namespace {

std::atomic<bool> stop_asked = false, results_begun = false;

void ask_to_stop(int) {
  if (!results_begun) _exit(130);  // reading, packing, bonding: nothing is lost
  stop_asked = true;
}

}  // namespace

void catch_signals() {
  // both would end the program on the spot; ignored, the write fails, and its caller says so
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  // SIGXCPU: a limit of time (ulimit -t) is near
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGXCPU}) sigaction(signal, &action, nullptr);
}

bool interrupted() { return stop_asked; }

void begin_results() { results_begun = true; }

}  // namespace breccia
