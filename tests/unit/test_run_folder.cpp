#include <doctest/doctest.h>

#include <fstream>

#include "core/base/error.hpp"
#include "io/files/digest.hpp"
#include "io/files/run_folder.hpp"
#include "io/text/input_file.hpp"
#include "scratch_folder.hpp"

using namespace breccia;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

const FolderUse use{{"case.toml", "frames/run-0/bonds-*.vtp"}, {}};

}  // namespace

TEST_CASE("The list of a folder knows what breccia wrote, and nothing else") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path / "out";
  {
    const FolderLock lock = claim_run_folder(folder, Old::refuse, use);
    CHECK(lock.names() == use.writes);
  }
  for (const char* name :
       {"case.toml", "case.toml.part", "frames/run-0/bonds-7.vtp", "frames/run-0/bonds-08.vtp.part",
        "frames/run-0/bonds-x.vtp", "frames/run-0/bonds-.vtp", "frames/run-0/bonds-7.vtp.bak", "notes.txt"})
    write(folder / name, "text");
  CHECK_THROWS_AS(claim_run_folder(folder, Old::refuse, use), BadInput);
  CHECK(fs::exists(folder / "case.toml"));
  CHECK(claim_run_folder(folder, Old::keep, {{"curve-0.csv"}, {}}).names() ==
        std::vector<std::string>{"curve-0.csv", "case.toml", "frames/run-0/bonds-*.vtp"});
  CHECK(fs::exists(folder / "case.toml"));
  CHECK(claim_run_folder(folder, Old::replace, {{"summary.json"}, {}}).names() ==
        std::vector<std::string>{"summary.json"});
  CHECK_FALSE(fs::exists(folder / "case.toml"));
  CHECK_FALSE(fs::exists(folder / "case.toml.part"));
  CHECK(names_in(folder / "frames/run-0", ".vtp") == std::vector<std::string>{"bonds-.vtp", "bonds-x.vtp"});
  CHECK(fs::exists(folder / "frames/run-0/bonds-7.vtp.bak"));
  CHECK(fs::exists(folder / "notes.txt"));
}

TEST_CASE("A folder of a version that kept no list is known by its resolved case") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path / "out";
  write(folder / "case.toml", "[specimen]\n");
  CHECK_THROWS_AS(claim_run_folder(folder, Old::replace, use), BadInput);
  write(folder / "case.toml", "# breccia-ucs: the case with every default written out\n");
  write(folder / "curve-0.csv", "mine, or of a test that this one is not");
  CHECK_THROWS_AS(claim_run_folder(folder, Old::refuse, use), BadInput);
  CHECK(fs::exists(folder / "case.toml"));
  claim_run_folder(folder, Old::replace, use);
  CHECK_FALSE(fs::exists(folder / "case.toml"));
  CHECK(fs::exists(folder / "curve-0.csv"));
}

TEST_CASE("A folder is locked as long as the lock is held, also within one process") {
  const ScratchFolder scratch;
  CHECK_FALSE(lock_folder_if_used(scratch.path));
  {
    FolderLock first = lock_folder(scratch.path);
    CHECK_THROWS_AS(lock_folder(scratch.path), BadInput);
    CHECK_THROWS_AS(lock_folder_if_used(scratch.path), BadInput);
    CHECK_THROWS_AS(claim_run_folder(scratch.path, Old::replace, use), BadInput);
    const FolderLock moved = claim_run_folder(scratch.path, Old::replace, use, std::move(first));
    CHECK_FALSE(first);
    CHECK_THROWS_AS(lock_folder(scratch.path), BadInput);
  }
  CHECK(lock_folder_if_used(scratch.path));
}

TEST_CASE("What a run reads is neither removed nor overwritten") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path / "out";
  { claim_run_folder(folder, Old::refuse, {{"specimen.csv", "case.toml"}, {}}); }
  write(folder / "specimen.csv", "spheres");
  write(folder / "case.toml", "case");
  fs::create_hard_link(folder / "specimen.csv", scratch.path / "same.csv");
  const FolderLock lock =
      claim_run_folder(folder, Old::replace, {{"case.toml"}, {scratch.path / "same.csv"}});
  CHECK(fs::exists(folder / "specimen.csv"));
  CHECK_FALSE(fs::exists(folder / "case.toml"));
  CHECK(lock.names() == std::vector<std::string>{"case.toml", "specimen.csv"});  // breccia's still
}

TEST_CASE("A digest is that of sha256sum") {
  const ScratchFolder scratch;
  write(scratch.path / "abc", "abc");
  CHECK(sha256_of(scratch.path / "abc") ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK_THROWS_AS(sha256_of(scratch.path), BadInput);
}
