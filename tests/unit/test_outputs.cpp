// Output files, read back: by our own eyes where they are text, by the readers that users have
// (h5py, VTK) where not.
#include <doctest/doctest.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>

#include "core/base/error.hpp"
#include "core/base/hold.hpp"
#include "core/tables/row_order.hpp"
#include "io/files/atomic_write.hpp"
#include "io/results/curve_csv.hpp"
#include "io/results/results_h5.hpp"
#include "io/results/summary_json.hpp"
#include "io/results/vtp.hpp"

namespace fs = std::filesystem;
using namespace breccia;

namespace {

/// A folder of its own for each test, gone with it.
struct TemporaryFolder {
  fs::path path;
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "breccia-outputs-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The line of the WriteError that `write` throws; empty when it does not.
template <class Write>
std::string trouble_of(Write&& write) {
  try {
    write();
  } catch (const WriteError& trouble) {
    return trouble.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Five particles whose rows are not in the order of their ids (gid = 50, 20, 40, 10, 30; the last
/// one held), and four bonds in a table padded to eight. Every number is a function of the gid,
/// which read_outputs.py knows too.
struct Scene {
  ParticleTable particles;
  BondTable bonds;
  explicit Scene(const Features& features = {}) {
    particles.resize(5, features);
    particles.free = 4;
    const Gid gids[] = {50, 20, 40, 10, 30};
    for (std::size_t i = 0; i < 5; ++i) {
      const double g = static_cast<double>(gids[i]);
      particles.gid[i] = gids[i];
      particles.radius[i] = 0.001 * g;
      particles.mass[i] = 0.1 * g;
      particles.reference_position[i] = {g, 2 * g, 3 * g};
      particles.position[i] = {g + 1e-3 * g, 2 * g, 3 * g};
      particles.velocity[i] = {0, 0, -g};
      if (features.rotation) particles.spin[i] = {g, 0, 0};
      particles.force[i] = {1, 1, 1};
    }
    bonds.resize(4, features, 8);
    const Row ends[][2] = {{4, 0}, {3, 1}, {1, 4}, {1, 2}};  // gids (30,50), (10,20), (20,30), (20,40)
    for (std::size_t i = 0; i < 4; ++i) {
      bonds.row_lo[i] = ends[i][0];
      bonds.row_hi[i] = ends[i][1];
      bonds.gid_lo[i] = particles.gid[ends[i][0]];
      bonds.gid_hi[i] = particles.gid[ends[i][1]];
      const double g = static_cast<double>(bonds.gid_lo[i] * 100 + bonds.gid_hi[i]);
      bonds.rest_length[i] = g;
      bonds.area[i] = 2 * g;
      bonds.stiffness[i] = 3 * g;
      if (features.contact_damping) bonds.damping[i] = 4 * g;
      bonds.shear_x[i] = g;
      bonds.shear_y[i] = -g;
      if (features.plasticity) bonds.plastic_stretch[i] = -g;
    }
    if (features.breakage) {
      bonds.damage_normal[0] = 1.0;  // (30,50) in tension
      bonds.damage_shear[1] = 1.0;   // (10,20) in shear
      bonds.damage_normal[3] = 0.5;
    }
  }
};

constexpr int no_such_reader = 77;  // as of ctest's SKIP_RETURN_CODE

/// Runs tests/unit/read_outputs.py WHAT FILE...; what it does not find as it should be it prints.
void check_with_python(const std::string& arguments) {
  const std::string script = std::string(BRECCIA_SOURCE_DIR) + "/tests/unit/read_outputs.py";
  const int status = std::system(("/usr/bin/python3 '" + script + "' " + arguments).c_str());
  REQUIRE(WIFEXITED(status));
  if (WEXITSTATUS(status) == no_such_reader) {
    MESSAGE("skipped 'python3-h5py or python3-vtk9 is not installed'");
  } else {
    CHECK(WEXITSTATUS(status) == 0);
  }
}

const std::vector<std::pair<std::string, double>> attributes{{"confinement_Pa", 4.5e6}, {"alpha", 1.25}};

/// A scene whose numbers deflate cannot shorten: the hardest for a promise about space.
Scene noise(std::size_t particle_count, std::size_t bond_count) {
  Scene scene;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  scene.particles.resize(particle_count, {});
  scene.bonds.resize(bond_count, {}, 8);
  const auto fill = [&](const ColumnInfo&, auto& column) {
    using T = ValueOf<decltype(column)>;
    for (T& value : column) {
      if constexpr (std::is_same_v<T, Vec3>) {
        value = {normal(random), normal(random), normal(random)};
      } else if constexpr (std::is_same_v<T, double>) {
        value = normal(random);
      } else {
        value = static_cast<T>(random() % particle_count);
      }
    }
  };
  scene.particles.for_each_column(fill);
  scene.bonds.for_each_column(fill);
  return scene;
}

/// A file system of a given size, in a mount name space of this process: it goes when the process
/// goes.
struct SmallDisk {
  fs::path path;
  bool mounted = false;
  SmallDisk(const fs::path& folder, const char* size) : path(folder) {
    fs::create_directories(path);
    mounted = ::unshare(CLONE_NEWNS) == 0 &&
              ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
              ::mount("tmpfs", path.c_str(), "tmpfs", 0, size) == 0;
    if (!mounted) MESSAGE("skipped 'a small tmpfs may not be mounted here'");
  }
  ~SmallDisk() {
    if (mounted) ::umount(path.c_str());
  }
};

}  // namespace

TEST_CASE("outputs: rows leave in order of global ids, without the padding") {
  const Scene scene;
  CHECK(rows_by_gid(scene.particles) == std::vector<Row>{3, 1, 4, 2, 0});
  CHECK(rows_by_ends(scene.bonds) == std::vector<Row>{1, 2, 3, 0});
}

TEST_CASE("outputs: atomic_write replaces a file and leaves nothing beside it") {
  const TemporaryFolder folder;
  atomic_write(folder.path / "a.txt", "old");
  atomic_write(folder.path / "a.txt", "new");
  CHECK(text_of(folder.path / "a.txt") == "new");
  CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1);
}

TEST_CASE("outputs: a path below a regular file is refused in one line with file, cause and cure") {
  const TemporaryFolder folder;
  atomic_write(folder.path / "file", "x");
  const fs::path below = folder.path / "file" / "curve-0.csv";
  const Scene scene;
  for (const std::string& line :
       {trouble_of([&] { atomic_write(below, "x"); }), trouble_of([&] { make_folder(below); }),
        trouble_of([&] { create_results(below, ""); }), trouble_of([&] { write_curve(below, {}); }),
        trouble_of([&] { write_frame_vtp(below, 0, 0, 0.0, scene.particles, scene.bonds); })}) {
    CAPTURE(line);
    CHECK(contains(line, below.string()));
    CHECK(contains(line, "Not a directory"));
    CHECK(contains(line, "--out"));
    CHECK(!contains(line, "\n"));
  }
  CHECK(contains(trouble_of([&] { make_folder(folder.path / "file"); }), "Not a directory"));
}

TEST_CASE("outputs: a file that is not HDF5, or is gone, is a WriteError in one line") {
  const TemporaryFolder folder;
  const Scene scene;
  const fs::path file = folder.path / "results.h5";
  const auto append = [&] {
    append_frame(file, 0, 0, {}, serial_partition(scene.particles.size), scene.particles, scene.bonds);
  };
  CHECK(contains(trouble_of(append), "No such file"));
  atomic_write(file, "not HDF5");
  const std::string line = trouble_of(append);
  CAPTURE(line);
  CHECK(contains(line, "results.h5"));
  CHECK(!contains(line, "\n"));
}

TEST_CASE("outputs: curve.csv has the columns of the design and reads back the same doubles") {
  const TemporaryFolder folder;
  CurveRow first;
  first.time_s = 0.1 + 0.2;
  first.axial_stress_Pa = 1.0 / 3.0 * 1e8;
  first.broken_tension = 12;
  first.work_J = -5e-324;
  write_curve(folder.path / "curve-0.csv", std::vector{first, CurveRow{}});
  std::istringstream lines(text_of(folder.path / "curve-0.csv"));
  std::string line;
  std::getline(lines, line);
  CHECK(
      line ==
      "time_s,axial_strain,platen_strain,axial_stress_Pa,radial_strain,volumetric_strain,confining_stress_Pa,"
      "broken_tension,broken_shear,kinetic_J,stored_J,dissipated_J,work_J");
  std::getline(lines, line);
  CHECK(line == "0.30000000000000004,0,0,33333333.333333332,,,0,12,0,,,,-5e-324");
  CHECK(std::strtod("33333333.333333332", nullptr) == first.axial_stress_Pa);
  std::getline(lines, line);
  CHECK(line == "0,0,0,0,,,0,0,0,,,,");
  CHECK(!std::getline(lines, line));
}

TEST_CASE("outputs: summary.json and the table of the terminal") {
  const TemporaryFolder folder;
  RunSummary run;
  run.confinement_Pa = 4.5e6;
  run.peak_stress_Pa = 60.25e6;
  run.peak_reached = true;
  run.young_modulus_Pa = 28e9;
  run.strain_at_peak = 0.0031;
  run.particles = 13500;
  run.run_time_s = 10;
  run.phases_s = {{"platens", 0.5}, {"bonds", 7.5}};
  run.energy_error = std::nan("");
  run.state_hash = "0123456789abcdef";
  run.stopped_by = "peak drop";
  run.warnings = {"kinetic ratio 2e-3: dynamic"};
  RunSummary other;
  other.peak_stress_Pa = 30e6;
  other.run_time_s = 10;
  other.phases_s = {{"bonds", 10}};
  other.stopped_by = "strain";
  SeriesSummary series{"triaxial", "0.1.0", 2, 1, {run, other}, MohrCoulomb{16e6, 40.5, 0.2e6, 2}};
  write_summary(folder.path / "summary.json", series);
  check_with_python("json '" + (folder.path / "summary.json").string() + "'");
  // the order in which keys are explained
  const std::string text = text_of(folder.path / "summary.json");
  CHECK(text.find("\"confinement_Pa\"") < text.find("\"peak_stress_Pa\""));
  CHECK(text.find("\"platens\"") < text.find("\"bonds\": 7.5"));

  const std::string table = format_summary_table(series, folder.path);
  CAPTURE(table);
  CHECK(contains(table, "60.25"));
  CHECK(contains(table, "> 30.00"));  // its peak was not reached
  CHECK(contains(table, "28.00"));
  CHECK(contains(table, "0.310"));
  CHECK(!contains(table, "tensile"));  // no run has one
  CHECK(!contains(table, "nan"));
  CHECK(contains(table, "time 20.0 s:  bonds 87.5 %  platens 2.5 %  other 10.0 %"));
  CHECK(contains(table, "cohesion 16.00 MPa, friction angle 40.5 deg"));
  CHECK(contains(table, "warning, run 0: kinetic ratio"));
  // the files that are there, and no others
  CHECK(contains(table, "files: " + (folder.path / "summary.json").string() + "\n"));
  for (const int run : {0, 1}) std::ofstream(folder.path / fmt::format("curve-{}.csv", run)) << "\n";
  CHECK(contains(format_summary_table(series, folder.path),
                 "summary.json, " + (folder.path / "curve-0.csv").string() + ", " +
                     (folder.path / "curve-1.csv").string() + "\n"));
  series.mohr_coulomb.reset();
  series.no_mohr_coulomb = "the peaks do not rise";
  CHECK(contains(format_summary_table(series, folder.path), "Mohr-Coulomb: none: the peaks do not rise\n"));
}

TEST_CASE("outputs: results.h5 as h5py reads it") {
  const TemporaryFolder folder;
  Scene scene;
  const fs::path file = folder.path / "results.h5";
  create_results(file,
                 "[material]\npreset = \"concrete\"\n" + std::string(70000, '#'));  // beyond the old 64 kB
  begin_run(file, 0, attributes, serial_partition(scene.particles.size), scene.particles, scene.bonds);
  append_frame(file, 0, 0, {0.0, 0, 0.0}, serial_partition(scene.particles.size), scene.particles,
               scene.bonds);
  append_frame(file, 0, 1, {1e-3, 10, 1e-4}, serial_partition(scene.particles.size), scene.particles,
               scene.bonds);
  append_frame(file, 0, 1, {2e-3, 20, 2e-4}, serial_partition(scene.particles.size), scene.particles,
               scene.bonds);  // as after a resume
  Features few;
  few.rotation = few.contact_damping = few.plasticity = few.breakage = false;
  const Scene lean(few);
  begin_run(file, 1, attributes, serial_partition(lean.particles.size), lean.particles, lean.bonds);
  append_frame(file, 1, 0, {0.0, 0, 0.0}, serial_partition(lean.particles.size), lean.particles, lean.bonds);
  check_with_python("h5 '" + file.string() + "'");
}

TEST_CASE("outputs: .vtp and .pvd as VTK reads them") {
  const TemporaryFolder folder;
  const Scene scene;
  for (const int frame : {0, 1, 2, 1}) {  // back to 1: as after a resume
    write_frame_vtp(folder.path / "frames", 0, frame, 0.5 * frame, scene.particles, scene.bonds);
  }
  check_with_python("vtp '" + (folder.path / "frames").string() + "'");
}

TEST_CASE("outputs: a specimen without bonds is written and read") {
  const TemporaryFolder folder;
  Scene scene;
  scene.bonds.resize(0, {}, 8);
  create_results(folder.path / "results.h5", "");
  begin_run(folder.path / "results.h5", 0, {}, serial_partition(scene.particles.size), scene.particles,
            scene.bonds);
  append_frame(folder.path / "results.h5", 0, 0, {}, serial_partition(scene.particles.size), scene.particles,
               scene.bonds);
  write_frame_vtp(folder.path / "frames", 0, 0, 0.0, scene.particles, scene.bonds);
  check_with_python("no-bonds '" + folder.path.string() + "'");
}

TEST_CASE("outputs: results.h5 stays within the space it claims, and gives back the rest") {
  const TemporaryFolder folder;
  const fs::path file = folder.path / "results.h5";
  const Scene scene = noise(20000, 40000);
  create_results(file, "");
  begin_run(file, 0, attributes, serial_partition(scene.particles.size), scene.particles, scene.bonds);
  for (int frame = 0; frame < 3; ++frame) {
    const std::uintmax_t before = fs::file_size(file);
    append_frame(file, 0, frame, {}, serial_partition(scene.particles.size), scene.particles, scene.bonds);
    const double raw = 20000 * 72.0 + 40000 * 49.0;  // bytes of the columns that change
    const double grown = static_cast<double>(fs::file_size(file) - before);
    CHECK(grown > 0.9 * raw);
    CHECK(grown < 1.01 * raw + 65536);
  }
}

TEST_CASE("outputs: on a full disk the earlier frames stay readable, and one line says so") {
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path / "disk", "size=1m");
  if (!disk.mounted) return;
  const Scene scene = noise(1000, 2000);
  const fs::path file = disk.path / "results.h5";
  create_results(file, "");
  begin_run(file, 0, attributes, serial_partition(scene.particles.size), scene.particles, scene.bonds);
  int frames = 0;
  std::string line;
  while (frames < 20 && line.empty()) {
    line = trouble_of([&] {
      append_frame(file, 0, frames, {}, serial_partition(scene.particles.size), scene.particles, scene.bonds);
    });
    if (line.empty()) ++frames;
  }
  CAPTURE(line);
  CHECK(frames > 1);
  CHECK(frames < 20);
  CHECK(contains(line, file.string()));
  CHECK(contains(line, "No space left on device; free some space"));
  check_with_python("frames '" + file.string() + "' " + std::to_string(frames));

  // what is left does not hold this one either; the old content survives, the half of the new one
  // goes
  atomic_write(disk.path / "curve-0.csv", "old");
  const std::string large(1 << 20, 'x');
  CHECK(contains(trouble_of([&] { atomic_write(disk.path / "curve-0.csv", large); }), "No space left"));
  CHECK(text_of(disk.path / "curve-0.csv") == "old");
  CHECK(!fs::exists(name_aside(disk.path / "curve-0.csv")));
  CHECK(contains(trouble_of([&] {
                   for (int i = 0; i < 99; ++i)
                     write_frame_vtp(disk.path, 0, i, 0.0, scene.particles, scene.bonds);
                 }),
                 "No space left"));
  // once there is room again, the next frame goes in
  fs::remove_all(disk.path / "run-0");
  fs::remove(disk.path / "curve-0.csv");
  REQUIRE(::mount("tmpfs", disk.path.c_str(), "tmpfs", MS_REMOUNT, "size=4m") == 0);
  append_frame(file, 0, frames, {}, serial_partition(scene.particles.size), scene.particles, scene.bonds);
  check_with_python("frames '" + file.string() + "' " + std::to_string(frames + 1));
}

TEST_CASE(
    "outputs: a kill in the middle of a frame leaves the earlier ones readable, and the file can be "
    "continued") {
  const TemporaryFolder folder;
  const Scene scene = noise(500, 1500);
  const auto append = [&](const fs::path& file, int frame) {
    append_frame(file, 0, frame, {}, serial_partition(scene.particles.size), scene.particles, scene.bonds);
  };
  std::vector<std::pair<fs::path, int>> killed;
  std::string left, continued;
  for (const char* point : {"results-claimed", "results-filled", "results-flushed", "results-linked"}) {
    for (const int whole : {1, 3}) {
      const fs::path file = folder.path / fmt::format("{}-{}.h5", point, whole);
      const fs::path mark = folder.path / "held";
      create_results(file, "");
      begin_run(file, 0, attributes, serial_partition(scene.particles.size), scene.particles, scene.bonds);
      const pid_t child = ::fork();
      REQUIRE(child >= 0);
      if (child == 0) {
        set_hold(fmt::format("{}:{}={}", point, whole + 1, mark.string()).c_str(), [] { return false; });
        for (int frame = 0; frame <= whole; ++frame) append(file, frame);
        ::_exit(1);  // it never came there
      }
      int status = 0;
      while (!fs::exists(mark) && ::waitpid(child, &status, WNOHANG) == 0) ::usleep(1000);
      REQUIRE(fs::exists(mark));
      REQUIRE(::kill(child, SIGKILL) == 0);
      REQUIRE(::waitpid(child, &status, 0) == child);
      fs::remove(mark);
      killed.emplace_back(file, whole);
      left += fmt::format(" '{}' {}", file.string(), whole);
      continued += fmt::format(" '{}' {}", file.string(), whole + 1);
    }
  }
  check_with_python("frames-at-least" + left);
  for (const auto& [file, whole] : killed) append(file, whole);
  check_with_python("frames" + continued);
}

TEST_CASE("outputs: more frames and runs than usual") {
  const TemporaryFolder folder;
  const Scene scene;
  const fs::path file = folder.path / "results.h5";
  create_results(file, "");
  for (int run = 0; run < 70; ++run)
    begin_run(file, run, {}, serial_partition(scene.particles.size), scene.particles, scene.bonds);
  for (int frame = 0; frame < 140; ++frame)
    append_frame(file, 0, frame, {}, serial_partition(scene.particles.size), scene.particles, scene.bonds);
  check_with_python("frames '" + file.string() + "' 140");
}

TEST_CASE("outputs: a folder that cannot be written to is named with the cure") {
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path / "disk", "size=1m");
  if (!disk.mounted) return;
  REQUIRE(::mount("tmpfs", disk.path.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr) == 0);
  for (const std::string& line : {trouble_of([&] { atomic_write(disk.path / "summary.json", "x"); }),
                                  trouble_of([&] { make_folder(disk.path / "frames"); }),
                                  trouble_of([&] { create_results(disk.path / "results.h5", ""); })}) {
    CAPTURE(line);
    CHECK(contains(line, "Read-only file system; choose a folder that you may write to with --out"));
  }
}
