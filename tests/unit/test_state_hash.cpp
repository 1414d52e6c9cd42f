// The fingerprint of a state sees every saved bit and nothing else.
#include <doctest/doctest.h>

#include "core/tables/state_hash.hpp"
#include "tests/scene.hpp"

using namespace breccia;

TEST_CASE(
    "state hash: 16 hex digits - one bit of any identity - history or state column changes it - scratch and "
    "reference and derived do not") {
  Assembly a = assemble(scene::small_packing(150), scene::small_cylinder(), {}, Features{}, 1);
  const auto fill = [](auto& table) {  // also what this scene does not need
    table.for_each_column([&](const ColumnInfo&, auto& column) {
      if constexpr (requires { column.resize(table.padded); }) column.resize(table.padded);
    });
  };
  fill(a.particles);
  fill(a.bonds);
  const std::string before = state_hash(a.particles, a.bonds);
  CHECK(before.size() == 16);
  CHECK(before.find_first_not_of("0123456789abcdef") == std::string::npos);
  int seen = 0;
  const auto flip_each = [&](auto pick) {
    Assembly changed = a;
    auto& table = pick(changed);
    const std::size_t rows = table.size;
    table.for_each_column([&](const ColumnInfo& info, auto& column) {
      for (const std::size_t row : {std::size_t{0}, rows / 2, rows - 1}) {
        const auto kept = column[row];
        auto* bytes = reinterpret_cast<unsigned char*>(&column[row]);
        bytes[0] ^= 1;
        if (info.role == Role::identity) bytes[0] ^= 1, bytes[7] ^= 0x40;  // ids stay different
        const bool saved =
            info.role == Role::identity || info.role == Role::history || info.role == Role::state;
        INFO(info.name, " row ", row);
        CHECK((state_hash(changed.particles, changed.bonds) != before) == saved);
        column[row] = kept;
        seen += saved;
      }
    });
  };
  flip_each([](Assembly& x) -> ParticleTable& { return x.particles; });
  flip_each([](Assembly& x) -> BondTable& { return x.bonds; });
  CHECK(seen >= 3 * 12);
}

TEST_CASE("state hash: the order of rows in memory and the padding do not matter [equal]") {
  Assembly a = assemble(scene::small_packing(150), scene::small_cylinder(), {}, Features{}, 1);
  REQUIRE(a.bonds.padded > a.bonds.size);
  const std::string before = state_hash(a.particles, a.bonds);
  a.bonds.shear_x[a.bonds.size] = 7;
  CHECK(state_hash(a.particles, a.bonds) == before);
  const auto exchange = [](auto& table, std::size_t r, std::size_t s) {
    table.for_each_column([&](const ColumnInfo&, auto& column) {
      if (!column.empty()) std::swap(column[r], column[s]);
    });
  };
  exchange(a.particles, 3, 77);
  exchange(a.bonds, 5, 210);
  CHECK(state_hash(a.particles, a.bonds) == before);
}
