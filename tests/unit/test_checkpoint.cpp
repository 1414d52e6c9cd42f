// A run that is taken up from a checkpoint in a world made anew: the same bits to the end, in every
// form of the loop; and the pieces that this stands on.
#include <doctest/doctest.h>

#include <fstream>

#include "core/base/error.hpp"
#include "core/tables/state_hash.hpp"
#include "core/world/make_world.hpp"
#include "io/cases/changed_keys.hpp"
#include "io/files/checksum.hpp"
#include "io/results/checkpoint.hpp"
#include "io/results/summary_json.hpp"
#include "tests/scene.hpp"
#include "tests/unit/scratch_folder.hpp"

using namespace breccia;
namespace fs = std::filesystem;

namespace {

struct Variant {
  const char* name;
  Loading loading = Loading::compression;
  double confinement = 0;
  ScatterKind scatter = ScatterKind::private_sums;
  Precision precision = Precision::full;
  DampingScheme scheme = DampingScheme::explicit_;
  bool ledger = true;
  std::vector<double> unload_at = {};
};

const Assembly& small_assembly() {
  static const Assembly a = assemble(scene::small_packing(300), scene::small_cylinder(), {}, Features{}, 1);
  return a;
}

World world_of(const Variant& v, int threads) {
  reference::Parameters p;
  p.alpha = 0.8;
  WorldOptions o;
  o.scatter = v.scatter;
  o.precision = v.precision;
  o.damping_scheme = v.scheme;
  o.ledger = v.ledger;
  o.threads = threads;
  return make_world(small_assembly(), scene::material_of(p), scene::factor(p), o);
}

LoadTest test_of(const Variant& v) {
  LoadTest test;
  test.loading = v.loading;
  test.confinement = v.confinement;
  test.platen_speed = 0.5;
  test.stop_strain = 0.006;
  test.stop_after_peak = 0;
  test.frames = 3;
  test.unload_at = v.unload_at;
  return test;
}

struct Outcome {
  std::string hash;
  LoadResult result;
  std::size_t cracks = 0, frames = 0;
  double energy_error = 0;
};

Outcome outcome_of(const World& w, const LoadState& state, const LoadResult& result) {
  return {state_hash(w.particles, w.bonds), result, w.cracks.cracks.size(), state.frames,
          energy_error(w.ledger)};
}

LoadHooks usual_hooks() {
  LoadHooks hooks;
  hooks.frame = [](World&, std::size_t, const CurveRow&) {};
  hooks.cracks = [](std::span<const Crack>) {};
  return hooks;
}

void check_equal(const Outcome& a, const Outcome& b) {
  CHECK(a.hash == b.hash);
  CHECK(a.cracks == b.cracks);
  CHECK(a.frames == b.frames);
  CHECK(a.energy_error == b.energy_error);
  CHECK(a.result.cycles.size() == b.result.cycles.size());
  CHECK(a.result.stage1_steps == b.result.stage1_steps);
  REQUIRE(a.result.record.rows.size() == b.result.record.rows.size());
  for (std::size_t k = 0; k < a.result.record.rows.size(); ++k) {
    const CurveRow &x = a.result.record.rows[k], &y = b.result.record.rows[k];
    CHECK(std::memcmp(&x, &y, sizeof x) == 0);
  }
}

/// Runs to the end; then again, stopped at the n-th chance and taken up in a world made anew, at
/// each n given.
void check_variant(const Variant& v, const std::vector<int>& stops, int threads_after) {
  INFO(v.name);
  Outcome whole;
  {
    World w = world_of(v, 1);
    LoadState state;
    LoadResult result;
    run_load_test(w, small_assembly(), test_of(v), usual_hooks(), state, result);
    whole = outcome_of(w, state, result);
  }
  CHECK(whole.cracks > 0);
  const ScratchFolder folder;
  int chance = 0;
  std::size_t next = 0;
  std::optional<FoundCheckpoint> found;
  for (bool done = false; !done;) {
    World w = world_of(v, found ? threads_after : 1);
    LoadState state;
    LoadResult result;
    if (found) read_checkpoint(*found, w, state, result);
    LoadHooks hooks = usual_hooks();
    hooks.interrupted = [&] { return next < stops.size() && ++chance >= stops[next]; };
    hooks.checkpoint = [&](World& world, const LoadState& at, const LoadResult& so_far) {
      write_checkpoint(folder.path, {"the case", next, "[]"}, world, at, so_far);
    };
    run_load_test(w, small_assembly(), test_of(v), hooks, state, result);
    done = result.stopped != Stopped::interrupted;
    if (done) {
      check_equal(outcome_of(w, state, result), whole);
      continue;
    }
    found = find_checkpoint(folder.path, [](const std::string&) { CHECK(false); });
    REQUIRE(found);
    CHECK(found->head.case_text == "the case");
    CHECK(found->head.run == next);
    ++next;
    chance = 0;
  }
  CHECK(next == stops.size());
}

}  // namespace

TEST_CASE("checkpoint: a run taken up gives the same bits as one that was never stopped") {
  const std::vector<int> stops{1, 40, 90, 5};
  check_variant({.name = "ucs, ledger"}, stops, 1);
  check_variant({.name = "confined, gather, summed, without ledger, other threads",
                 .confinement = 5e6,
                 .scatter = ScatterKind::gather,
                 .scheme = DampingScheme::summed,
                 .ledger = false},
                {3, 2, 30, 100}, 2);
  check_variant({.name = "single precision", .precision = Precision::single}, stops, 1);
  check_variant({.name = "cycles", .ledger = false, .unload_at = {0.0012, 0.002}}, {20, 60, 60, 60}, 1);
  check_variant({.name = "hydrostatic, ledger, gather",
                 .loading = Loading::hydrostatic,
                 .confinement = 120e6,
                 .scatter = ScatterKind::gather},
                {2, 30}, 2);
}

TEST_CASE("checkpoint: of two generations the newest whole one is taken, damage is said") {
  const ScratchFolder folder;
  World w = world_of({.name = ""}, 1);
  LoadState state;
  LoadResult result;
  for (std::size_t run : {0u, 1u}) write_checkpoint(folder.path, {"c", run, "[]"}, w, state, result);
  std::vector<std::string> said;
  const auto find = [&] {
    return find_checkpoint(folder.path, [&](const std::string& s) { said.push_back(s); });
  };
  CHECK(find()->head.run == 1);
  CHECK(said.empty());
  const auto flip = [&](const fs::path& file) {
    std::fstream f(file, std::ios::in | std::ios::out | std::ios::binary);
    f.seekp(static_cast<std::streamoff>(fs::file_size(file) / 3));
    const int byte = f.peek();
    f.put(static_cast<char>(byte ^ 1));
  };
  flip(folder.path / "checkpoint.h5");
  CHECK(find()->head.run == 0);
  REQUIRE(said.size() == 1);
  CHECK(said[0].find("checkpoint.h5: damaged, not used") != std::string::npos);
  fs::resize_file(folder.path / "checkpoint-before.h5", 5000);
  CHECK_FALSE(find());
  remove_checkpoints(folder.path);
  CHECK(fs::is_empty(folder.path));
}

TEST_CASE("checkpoint: a world of other spheres is refused") {
  const ScratchFolder folder;
  World w = world_of({.name = ""}, 1);
  LoadState state;
  LoadResult result;
  write_checkpoint(folder.path, {"c", 0, "[]"}, w, state, result);
  const auto found = find_checkpoint(folder.path, [](const std::string&) {});
  const Assembly other = assemble(scene::small_packing(290), scene::small_cylinder(), {}, Features{}, 1);
  reference::Parameters p;
  World u = make_world(other, scene::material_of(p), scene::factor(p), {});
  CHECK_THROWS_WITH_AS(read_checkpoint(*found, u, state, result), doctest::Contains("another specimen"),
                       BadInput);
}

TEST_CASE("seal: every changed, missing or added byte is seen") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "f";
  const std::string text = "some 40 bytes of text, and a few more.....";
  const auto write = [&](const std::string& content) { std::ofstream(file, std::ios::binary) << content; };
  write(text);
  CHECK_FALSE(is_sealed(file));
  append_checksum(file);
  CHECK(is_sealed(file));
  std::ifstream in(file, std::ios::binary);
  const std::string sealed{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t k = 0; k < sealed.size(); ++k)
    for (int bit = 0; bit < 8; ++bit) {
      std::string changed = sealed;
      changed[k] = static_cast<char>(changed[k] ^ (1 << bit));
      write(changed);
      CHECK_FALSE(is_sealed(file));
    }
  for (std::size_t k = 0; k < sealed.size(); ++k) {
    write(sealed.substr(0, k));
    CHECK_FALSE(is_sealed(file));
  }
  write(sealed + 'x');
  CHECK_FALSE(is_sealed(file));
}

TEST_CASE("case change: keys that differ are named, those of output and checkpoints are not") {
  const std::string before =
      "# a case\n[test]\nspeed = 1\nstop = \"2 mm\"\n\n[output]\nframes = 3\n[run]\ncheckpoint_every = 1\n";
  CHECK(changed_keys(before, before).empty());
  CHECK(changed_keys(
            before, "[test]\nspeed = 1\nstop = \"2 mm\"\n[output]\nframes = 0\n[run]\ncheckpoint_every = 2\n")
            .empty());
  const auto changed = changed_keys(before, "[test]\nspeed = 2\nnew = 1\n");
  REQUIRE(changed.size() == 3);
  CHECK(changed[0] == "test.new = 1, was absent");
  CHECK(changed[1] == "test.speed = 2, was 1");
  CHECK(changed[2] == "test.stop absent, was \"2 mm\"");
  CHECK(changed_keys("[[material.at]]\nE = 1\n[[material.at]]\nE = 2\n",
                     "[[material.at]]\nE = 1\n[[material.at]]\nE = 3\n") ==
        std::vector<std::string>{"material.at[1].E = 3, was 2"});
}

TEST_CASE("summary: runs come back from their text as they were") {
  RunSummary run;
  run.confinement_Pa = 4.5e6;
  run.peak_stress_Pa = 1.0 / 3.0;
  run.steps = (1ull << 60) + 1;
  run.phases_s = {{"search", 0.25}, {"bonds", 1e-9}};
  run.cycles = {{1, 2, 3, 4}};
  run.first_cracks = "central";
  run.bulk_modulus_Pa = 17e9;
  run.warnings = {"one", "two"};
  run.stopped_by = "strain";
  const std::vector<RunSummary> back = read_runs(runs_text({run, run}));
  REQUIRE(back.size() == 2);
  CHECK(runs_text(back) == runs_text({run, run}));
  CHECK(back[1].peak_stress_Pa == run.peak_stress_Pa);
  CHECK(back[1].steps == run.steps);
  CHECK(back[1].phases_s == run.phases_s);
  CHECK_FALSE(back[1].young_modulus_Pa);
}
