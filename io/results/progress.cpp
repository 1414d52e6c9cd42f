#include "io/results/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "io/files/standard_streams.hpp"

namespace breccia {
namespace {

using std::chrono::steady_clock;

double seconds_since(steady_clock::time_point t) {
  return std::chrono::duration<double>(steady_clock::now() - t).count();
}

std::string clock_time(double seconds) {
  const auto s = static_cast<long>(seconds);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{}:{:02}", s / 60, s % 60);
}

void clear(Progress& p) {
  if (p.drawn) print_out("\r\033[K");
  p.drawn = false;
}

}  // namespace

Progress make_progress(bool quiet) {
  Progress p;
  p.quiet = quiet;
  // mpirun gives its ranks a terminal even where all they say goes into a file
  p.terminal = ranks_of_launcher().alone() && isatty(STDOUT_FILENO) == 1;
  return p;
}

void begin(Progress& p, const std::string& title) {
  p.title = title;
  p.start = p.last = steady_clock::now();
}

void tell(Progress& p, const World& w, int stage, double fraction, const CurveRow& row) {
  const double pause = p.terminal ? 0.2 : 10.0;
  if (p.quiet || seconds_since(p.last) < pause) return;
  p.last = steady_clock::now();
  const double elapsed = seconds_since(p.start);
  const World& whole = w.replica ? *w.replica : w;
  const double speed = static_cast<double>(whole.bonds.size) * static_cast<double>(w.step) / elapsed;
  const std::string left = fraction > 0.01 && stage == 2 ? clock_time(elapsed * (1.0 / fraction - 1.0)) : "-";
  const std::string line = fmt::format(
      "{}  {}  {:3.0f} %  step {}  strain {:.5f}  stress {:.2f} MPa  broken {:.0f}  {:.0f} Mbond/s  left at "
      "most {}",
      p.title, stage == 1 ? "hydrostatic" : "axial", 100.0 * fraction, w.step, row.axial_strain,
      row.axial_stress_Pa * 1e-6, row.broken_tension + row.broken_shear, speed * 1e-6, left);
  if (p.terminal) {
    print_out("\r\033[K" + line);
    p.drawn = true;
  } else {
    print_out(line + '\n');
  }
}

void say(Progress& p, const std::string& line) {
  if (p.quiet) return;
  clear(p);
  print_out(line + '\n');
}

}  // namespace breccia
