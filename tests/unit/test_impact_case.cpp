#include <doctest/doctest.h>

#include <string>

#include "core/base/error.hpp"
#include "io/cases/keys_schema.hpp"
#include "io/impact_cases/impact_case.hpp"
#include "io/impact_cases/impact_keys.hpp"
#include "scratch_folder.hpp"

using namespace breccia;

namespace {

const std::string good =
    "[materials.glass]\n"               // 1
    "density = \"2.8 g/cm3\"\n"         // 2
    "young_modulus = \"48 GPa\"\n"      // 3
    "poisson_ratio = 0.2\n"             // 4
    "[time]\n"                          // 5
    "duration = \"60 us\"\n"            // 6
    "[[particle]]\n"                    // 7
    "position = [0, 0, \"10 mm\"]\n"    // 8
    "velocity = [0, 0, \"-10 m/s\"]\n"  // 9
    "radius = \"10 mm\"\n"              // 10
    "material = \"glass\"\n"            // 11
    "[[wall]]\n"                        // 12
    "kind = \"plane\"\n"                // 13
    "point = [0, 0, 0]\n"               // 14
    "normal = [0, 0, 2]\n"              // 15
    "material = \"glass\"\n";           // 16

ImpactCase load(const std::string& text, const std::vector<std::string>& sets = {}) {
  const ScratchFolder folder;
  return load_impact_case(folder.write("c.toml", text), sets);
}

/// `good` with one text replaced; what it is refused with, the scratch folder taken off.
std::string complaint(const std::string& from, const std::string& to,
                      const std::vector<std::string>& sets = {}) {
  const ScratchFolder folder;
  std::string text = good;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  try {
    load_impact_case(folder.write("c.toml", text), sets);
  } catch (const BadInput& error) {
    std::string line = error.what();
    REQUIRE(line.find('\n') == std::string::npos);
    if (const auto path = line.find(folder.path.string() + "/"); path == 0)
      line.erase(0, folder.path.string().size() + 1);
    return line;
  }
  return "accepted";
}

void says(const std::string& text, const std::string& wanted) {
  INFO(text);
  CHECK(text.starts_with(wanted));
}

}  // namespace

TEST_CASE("impact case: every key is read units are taken off the resolved case reads back the same") {
  const ImpactCase c = load(good, {"particle.1.spin=[0, \"3 rad/s\", -1]", "contact.law=linear",
                                   "contact.stiffness=\"5 kN/mm\"", "scene.gravity=[0, 0, \"-9.81 m/s^2\"]",
                                   "materials.glass.restitution=0.5", "output.rows=7", "time.safety=0.01"});
  const ImpactScene& s = c.scene;
  CHECK(s.materials.at(0).density == 2800);
  CHECK(s.materials[0].restitution == 0.5);
  CHECK(s.materials[0].friction == 0);
  CHECK(s.particles.at(0).position == Vec3{0, 0, 0.01});
  CHECK(s.particles[0].velocity == Vec3{0, 0, -10});
  CHECK(s.particles[0].spin == Vec3{0, 3, -1});
  CHECK(s.walls.at(0).shape.direction == Vec3{0, 0, 1});
  CHECK(s.law == ContactLaw::linear);
  CHECK(s.stiffness == 5e6);
  CHECK(s.gravity == Vec3{0, 0, -9.81});
  CHECK(s.duration == 60e-6);
  CHECK(s.safety == 0.01);
  CHECK(s.rows == 7);
  CHECK(load(c.resolved).resolved == c.resolved);
}

TEST_CASE("impact case: what is wrong is refused with its place and the cure") {
  says(complaint("radius =", "radus ="), "c.toml:10: particle.radus: unknown key; did you mean \"radius\"?");
  says(complaint("[time]", "[tme]"), "c.toml:5: tme: unknown table; did you mean \"time\"?");
  says(complaint("duration = \"60 us\"\n", ""), "c.toml:5: time.duration: missing; a time");
  says(complaint("\"60 us\"", "\"60 mm\""),
       "c.toml:6: time.duration: \"60 mm\" is a length; a time is wanted");
  says(complaint("radius = \"10 mm\"\n", ""), "c.toml:7: particle.radius: missing");
  says(complaint("radius = \"10 mm\"", "radius = \"-10 mm\""),
       "c.toml:10: particle.radius: must be more than 0 m");
  says(complaint("[0, 0, \"10 mm\"]", "[0, \"10 mm\"]"), "c.toml:8: particle.position: 3 values are wanted");
  says(complaint("material = \"glass\"\n", "material = \"glas\"\n"),
       "c.toml:7: particle.material: no [materials.glas]; did you mean \"glass\"?");
  says(complaint("density = \"2.8 g/cm3\"\n", ""),
       "c.toml:6: particle.material: [materials.glass] has no density");
  says(complaint("kind = \"plane\"", "kind = \"plan\""),
       "c.toml:13: wall.kind: unknown \"plan\"; did you mean \"plane\"?");
  says(complaint("kind = \"plane\"\n", ""), "c.toml:12: wall.kind: missing");
  says(complaint("normal =", "axis ="), "c.toml:15: wall.axis: belongs to kind \"cylinder\"; leave it out");
  says(complaint("normal = [0, 0, 2]\n", ""), "c.toml:12: wall.normal: missing");
  says(complaint("[0, 0, 2]", "[0, 0, 0]"), "c.toml:12: wall: a direction has no length");
  says(complaint("[[wall]]", "[wall]"), "c.toml:12: wall: write [[wall]], once for each");
  says(complaint("poisson_ratio = 0.2", "poisson_ratio = 0.5"),
       "c.toml:4: materials.poisson_ratio: must be from 0 to below 0.5");
  says(complaint("velocity = [0, 0, \"-10 m/s\"]", "spin = [\"1 Hz\", 0, 0]"),
       "c.toml:9: particle.spin: \"1 Hz\": write rad/s");
  says(complaint("velocity = [0, 0, \"-10 m/s\"]\n", ""), "c.toml:7: particle.velocity: nothing moves");
  says(complaint("[0, 0, \"10 mm\"]", "[0, 0, \"9 mm\"]"),
       "c.toml:8: particle.position: particle 1 reaches 0.001 m into or beyond wall 1");
  says(complaint("[time]", "[contact]\nstiffness = \"1 N/m\"\n[time]"),
       "c.toml:5: contact.stiffness: belongs to law");
  says(complaint("[time]", "[materials.odd]\nyoung_modulus = 1\nrestitution = 0\npoisson_ratio = 0\n[time]"),
       "c.toml:7: materials.restitution: must be from 0.01 to 1, not 0");
  says(complaint("kind = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 2]",
                 "kind = \"triangle\"\nfirst = [0, 0, 0]\nsecond = [1, 1, 0]\nthird = [2, 2, 0]"),
       "c.toml:12: wall: the three corners lie on one line");
}

TEST_CASE("impact case: --set names what it cannot find") {
  says(complaint("[time]", "[time]", {"particle.3.radius=1"}),
       "--set: particle.3.radius: \"3\" is not a number from 1 to 1");
  says(complaint("[time]", "[time]", {"particle.radius=1"}),
       "--set: particle.radius: is not a key of a table");
  says(complaint("[time]", "[time]", {"duration=1"}), "--set: \"duration=1\": write --set table.key=value");
  says(complaint("[time]", "[time]", {"time.duraton=1"}),
       "--set: time.duraton: unknown key; did you mean \"duration\"?");
  says(complaint("[time]", "[time]", {"time.duration.x=1"}),
       "--set: time.duration.x: is not a key of a table");
}

TEST_CASE("impact case: every declaration is whole and the printed reference lists it") {
  const std::string help = describe_impact_keys();
  const auto check = [&](const auto& fields) {
    for (const auto& field : fields) {
      INFO(field.key.name);
      CHECK(!field.key.meaning.empty());
      CHECK(bool(field.store));
      CHECK(!(field.required && !field.key.default_text.empty()));
      const std::string word(field.key.name.substr(field.key.name.rfind('.') + 1));
      CHECK(help.find("  " + word + " ") != std::string::npos);
    }
  };
  check(scene_fields());
  check(material_fields());
  check(particle_fields());
  check(wall_fields());
}

TEST_CASE("impact case: the examples in data/cases load") {
  const std::filesystem::path cases = std::filesystem::path(BRECCIA_SOURCE_DIR) / "data/cases";
  CHECK(load_impact_case(cases / "impact-two-spheres.toml", {}).scene.particles.size() == 2);
  CHECK(load_impact_case(cases / "impact-wall.toml", {}).scene.walls.size() == 1);
}
