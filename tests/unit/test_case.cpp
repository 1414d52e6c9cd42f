#include <doctest/doctest.h>

#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "io/cases/case.hpp"
#include "io/cases/keys_schema.hpp"
#include "io/reference/keys_reference.hpp"
#include "scratch_folder.hpp"

using namespace breccia;

namespace {

const std::string body = "[specimen]\ndiameter = \"150 mm\"\nheight = \"300 mm\"\n";  // lines 1 to 3
const std::string pack = body + "pack.spheres = 100\n";                               // line 4
const std::string good = pack + "[material]\npreset = \"concrete\"\n";                // lines 5, 6

Case load(const std::string& text, const std::string& test = "triaxial",
          const std::vector<std::string>& sets = {}) {
  const ScratchFolder folder;
  return load_case(folder.write("c.toml", text), sets, test);
}

/// What a case is refused with, the scratch folder taken off.
std::string complaint(const std::string& text, const std::string& test = "triaxial",
                      const std::vector<std::string>& sets = {}) {
  const ScratchFolder folder;
  folder.write("spheres.csv", "id,x_m,y_m,z_m,r_m\n1,0,0,0,1\n");
  folder.write("materials/bad.toml", "density = 1\nyoung_modulus = \"1 m\"\n");
  folder.write("materials/typo.toml", "densty = 1\n");
  folder.write("materials/twice.toml", "[[at]]\nconfinement = 5\n[[at]]\nconfinement = 5\n");
  folder.write("materials/thin.toml",
               "source = \"here\"\ndensity = 1000\nyoung_modulus = 1e9\npoisson_ratio = 0.3\n");
  const auto file = folder.write("c.toml", text);
  try {
    load_case(file, sets, test);
  } catch (const BadInput& error) {
    std::string line = error.what();
    REQUIRE(line.find('\n') == std::string::npos);
    for (std::size_t at; (at = line.find(folder.path.string() + "/")) != std::string::npos;)
      line.erase(at, folder.path.string().size() + 1);
    return line;
  }
  return "accepted";
}

void says(const std::string& text, const std::string& wanted) {
  INFO(text);
  CHECK(text.starts_with(wanted));
}

}  // namespace

TEST_CASE("case: every key is read, units are taken off") {
  const ScratchFolder folder;
  folder.write("mesh/s.csv", "id,x_m,y_m,z_m,r_m\n1,0,0,0,1\n");
  const auto file = folder.write("c.toml", R"(
[specimen]
file = "mesh/s.csv"
shape = "cylinder"
axis = "y"
diameter = "1 in"
height = 0.3
centre = ["1 mm", 0, "-3 cm"]
[material]
preset = "concrete"
young_modulus = "27 GPa"
criterion = "mohr-coulomb"
[[material.at]]
confinement = "60 MPa"
limit_compressive_stress = ["30 MPa", "50 MPa", "80 MPa"]
damage_normal = 0.4
[bonds]
coordination = 10
alpha = 0.79
elasticity = "matched"
area = "minimum"
[damping]
contact = 0.5
form = "paper"
scheme = "explicit"
translation = 0.2
[test]
confinement = ["0 MPa", "4.5 MPa", "9 MPa", "60 MPa"]
platens = "smooth"
platen_speed = "5 cm/s"
stop_strain = "3 %"
stop_after_peak = 0
[time]
accuracy = "normal"
safety = 0.7
mass_scaling = false
[run]
scatter = "gather"
[features]
rotation = false
plasticity = true
breakage = true
new_contacts = false
[output]
frames = 5
)");
  const Case c = load_case(file, {}, "triaxial");
  CHECK(c.source == file);
  CHECK(c.preset == "concrete");
  CHECK(c.specimen.file == folder.path / "mesh/s.csv");
  CHECK(!c.specimen.pack);
  CHECK(c.specimen.body.shape == Shape::cylinder);
  CHECK(c.specimen.body.diameter == 0.0254);
  CHECK(c.specimen.body.height == 0.3);
  CHECK(c.specimen.axis == 'y');
  CHECK(*c.specimen.centre == Vec3{0.001, 0, -0.03});
  CHECK(*c.bonds.coordination == 10);
  CHECK(c.bonds.alpha_rule == AlphaRule::number);
  CHECK(c.bonds.alpha == 0.79);
  CHECK(c.bonds.elasticity == Elasticity::matched);
  CHECK(c.damping.contact == 0.5);
  CHECK(c.damping.paper_form);
  CHECK(c.damping.translation == 0.2);
  CHECK(c.test.confinement == std::vector<double>{0, 4.5e6, 9e6, 60e6});
  CHECK(!c.test.rough_platens);
  CHECK(c.test.platen_speed == 0.05);
  CHECK(c.test.stop_strain == 0.03);
  CHECK(c.test.stop_after_peak == 0);
  CHECK(c.safety == 0.7);
  CHECK(c.scatter == ScatterKind::gather);
  CHECK(!c.features.rotation);
  CHECK(!c.features.new_contacts);
  CHECK(c.frames == 5);
  REQUIRE(c.materials.size() == 4);
  CHECK(c.materials[0].young_modulus == 27e9);
  CHECK(c.materials[0].limit_compressive_stress == std::array{20e6, 45e6, 70e6});
  CHECK(c.materials[3].limit_compressive_stress == std::array{30e6, 50e6, 80e6});
  CHECK(c.materials[3].damage_normal == 0.4);
  CHECK(c.materials[0].damage_normal == 0.2);
  CHECK(c.materials[1].damage_normal == doctest::Approx(0.2 + 0.2 * 4.5 / 60).epsilon(1e-12));  // on the line
  CHECK(c.materials[3].damage_shear == 0.2);
  CHECK(c.materials[3].criterion == Criterion::mohr_coulomb);
}

TEST_CASE("case: defaults") {
  const Case c = load(good, "ucs");
  CHECK(c.specimen.pack->spheres == 100);
  CHECK(c.specimen.pack->porosity == 0.26);
  CHECK(c.specimen.pack->seed == 1);
  CHECK(c.specimen.pack->sizes.kind == SizeDistribution::Kind::lognormal);
  CHECK(c.specimen.pack->sizes.spread == 0.26);
  CHECK(c.specimen.axis == 'z');
  CHECK(c.bonds.range == 0.1);
  CHECK(!c.bonds.coordination);
  CHECK(c.bonds.alpha_rule == AlphaRule::automatic);
  CHECK(c.bonds.elasticity == Elasticity::paper);
  CHECK(c.damping.contact == 0.9);
  CHECK(!c.damping.paper_form);
  CHECK(c.damping.translation == 0.1);
  CHECK(c.damping.rotation == 0.1);
  CHECK(c.test.confinement == std::vector<double>{0});
  CHECK(c.test.rough_platens);
  CHECK(c.test.platen_speed == 0.1);
  CHECK(c.test.stop_strain == 0.02);
  CHECK(c.test.stop_after_peak == 0.5);
  CHECK(c.safety == 0.8);
  CHECK(c.scatter == ScatterKind::private_sums);
  CHECK(c.frames == 20);
  CHECK(load(good, "bts").specimen.body.shape == Shape::disc);
  CHECK(load(good + "[run]\nscatter = \"atomic\"\n").scatter == ScatterKind::atomic);
  // the struct's own defaults are those of the declarations
  CHECK(BondsCase{}.range == c.bonds.range);
  CHECK(DampingCase{}.contact == c.damping.contact);
  CHECK(TestCase{}.platen_speed == c.test.platen_speed);
  CHECK(Case{}.frames == c.frames);
  CHECK(Case{}.safety == c.safety);
  CHECK(c.damping.scheme == DampingScheme::explicit_);
  CHECK(load(good + "[damping]\nscheme = \"capped\"\n").damping.scheme == DampingScheme::capped);
  CHECK(load(good + "[damping]\nscheme = \"summed\"\n").damping.scheme == DampingScheme::summed);
  CHECK(!c.mass_scaling);
  CHECK(Case{}.mass_factor == c.mass_factor);
  const Case heavy = load(good + "[time]\nmass_scaling = true\nmass_factor = 1.2\n");
  CHECK(heavy.mass_scaling);
  CHECK(heavy.mass_factor == 1.2);
}

TEST_CASE("case: presets carry the values of the paper's tables") {
  const Material concrete = load(good).materials[0];
  CHECK(concrete.density == 2500);
  CHECK(concrete.young_modulus == 28e9);
  CHECK(concrete.poisson_ratio == 0.2);
  CHECK(concrete.friction_static == 0.9);
  CHECK(concrete.friction_dynamic == 0.25);
  CHECK(concrete.tensile_strength == 5e6);
  CHECK(concrete.shear_strength == 16e6);
  CHECK(concrete.stiffness_reduction == std::array{3.0, 12.0, 22.0});
  CHECK(concrete.damage_normal == 0.2);
  CHECK(concrete.damage_shear == 0.2);
  const std::string cement = pack + "[material]\npreset = \"cement\"\n[test]\nconfinement = ";
  const auto limits = [&](const char* p) {
    return load(cement + p).materials.at(0).limit_compressive_stress;
  };
  CHECK(limits("0") == std::array{8.5e6, 9e6, 11e6});
  CHECK(limits("\"500 psi\"") == std::array{9.5e6, 11e6, 13e6});
  CHECK(limits("\"3.447379 MPa\"") == std::array{9.5e6, 11e6, 13e6});  // within one in a million
  CHECK(limits("\"1 ksi\"") == std::array{10e6, 11e6, 14e6});
  CHECK(limits("[\"2000 psi\"]") == std::array{13e6, 14e6, 15e6});
  CHECK(limits("[\"4000 psi\"]") == std::array{21e6, 23e6, 26e6});
  // on the straight line between two confinements of the table, and at its end beyond it
  const std::array between = limits("[\"700 psi\"]"), wanted{9.7e6, 11e6, 13.4e6};
  for (const std::size_t k : {0u, 1u, 2u}) CHECK(between[k] == doctest::Approx(wanted[k]).epsilon(1e-9));
  CHECK(limits("[\"9000 psi\"]") == std::array{21e6, 23e6, 26e6});
  CHECK(load(cement + "0").materials[0].density == 1700);
  const Material shale = load(pack + "[material]\npreset = \"shale\"\n").materials[0];
  CHECK(shale.shear_strength == 25e6);
  CHECK(shale.stiffness_reduction == std::array{1.0, 1.0, 1.0});
}

TEST_CASE("case: precedence --set > [[material.at]] > [material] > the preset's [[at]] > the preset") {
  const ScratchFolder folder;
  folder.write("materials/m.toml", R"(
density = 1
young_modulus = 1
poisson_ratio = 0.1
friction_static = 1
friction_dynamic = 1
tensile_strength = 1
shear_strength = 1
limit_compressive_stress = [1, 1, 1]
stiffness_reduction = [1, 1, 1]
damage_normal = 1
damage_shear = 1
[[at]]
confinement = 5
young_modulus = 2
friction_static = 2
friction_dynamic = 2
tensile_strength = 2
fracture_energy_shear = 2
)");
  const auto file = folder.write("cases/c.toml", pack + R"(
[material]
preset = "m"
friction_static = 3
friction_dynamic = 3
tensile_strength = 3
[[material.at]]
confinement = 5
friction_dynamic = 4
tensile_strength = 4
[test]
confinement = [0, 5]
)");  // the preset lies beside the case's folder
  const Case c = load_case(file, {"material.tensile_strength=5", "material.damage_normal = 5"}, "triaxial");
  const Material &none = c.materials.at(0), &five = c.materials.at(1);
  CHECK(five.shear_strength == 1);
  CHECK(five.young_modulus == 2);
  CHECK(five.friction_static == 3);
  CHECK(five.friction_dynamic == 4);
  CHECK(five.tensile_strength == 5);
  CHECK(five.damage_normal == 5);
  CHECK(*five.fracture_energy_shear == 2);
  CHECK(five.damage_shear == 0);
  CHECK(none.young_modulus == 1);
  CHECK(none.friction_dynamic == 3);
  CHECK(none.damage_shear == 1);
  CHECK(!none.fracture_energy_shear);
}

TEST_CASE("case: a preset is also found through BRECCIA_DATA") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path / "materials");
  std::filesystem::copy_file(std::string(BRECCIA_SOURCE_DIR) + "/data/materials/shale.toml",
                             folder.path / "materials/mine.toml");
  ::setenv("BRECCIA_DATA", folder.path.c_str(), 1);
  CHECK(load(pack + "[material]\npreset = \"mine\"\n").materials[0].young_modulus == 30e9);
  ::unsetenv("BRECCIA_DATA");
  says(complaint(pack + "[material]\npreset = \"mine\"\n"),
       "c.toml:6: material.preset: no preset \"mine\"; valid: \"bad\", \"cement\", ");
}

TEST_CASE("case: --set takes TOML, or a bare word, the last one wins, it replaces what it excludes") {
  const std::vector<std::string> sets{"test.stop_strain=0.03",      "test.confinement=[\"1 MPa\", 2e6]",
                                      "run.scatter=gather",         "test.platen_speed=0.05 m/s",
                                      "test.platen_speed=0.02 m/s", "bonds.coordination=9"};
  const Case c =
      load(good + "[bonds]\nrange = 0.05\n[[material.at]]\nconfinement = 7\ndensity = 1\n", "triaxial", sets);
  CHECK(c.test.stop_strain == 0.03);
  CHECK(c.test.confinement == std::vector<double>{1e6, 2e6});
  CHECK(c.scatter == ScatterKind::gather);
  CHECK(c.test.platen_speed == 0.02);
  CHECK(*c.bonds.coordination == 9);
  CHECK(c.resolved.find("range =") == std::string::npos);
  const Case p = load(good, "ucs", {"specimen.pack={spheres=5, sizes={kind=\"uniform\", spread=0.4}}"});
  CHECK(p.specimen.pack->spheres == 5);
  CHECK(p.specimen.pack->sizes.kind == SizeDistribution::Kind::uniform);
  CHECK(p.specimen.pack->sizes.spread == 0.4);
  const ScratchFolder folder;
  const auto mesh = folder.write("s.csv", "id,x_m,y_m,z_m,r_m\n1,0,0,0,1\n");
  CHECK(load(good, "ucs", {"specimen.file=" + mesh.string()}).specimen.file == mesh);
  CHECK(!load(good, "ucs", {"specimen.file=" + mesh.string()}).specimen.pack);
  const Case at = load(good + "[test]\nconfinement = 5\n", "triaxial",
                       {"material.at=[{confinement=0, density=7}]", "test.confinement=0"});
  CHECK(at.materials.at(0).density == 7);
}

/// The resolved case without what it notes behind a confinement: which values of a table hold
/// there. Read back, they are the case's own.
std::string without_notes(const std::string& resolved) {
  static const std::regex note("\\[\\[material\\.at\\]\\][^\n]*");
  return std::regex_replace(resolved, note, "[[material.at]]");
}

TEST_CASE("case: the resolved case reads back to itself") {
  const ScratchFolder folder;
  folder.write("s.csv", "id,x_m,y_m,z_m,r_m\n1,0,0,0,1\n");
  const std::string filed =
      body + "file = \"s.csv\"\naxis = \"x\"\ncentre = [0.1, \"1 in\", 0]\n[material]\npreset = \"cement\"\n";
  struct Try {
    std::string test, text;
    std::vector<std::string> sets;
  };
  const std::string sieves = body +
                             "[specimen.pack]\nspheres = 9\nsizes = {kind = \"sieves\", openings = [\"2 "
                             "mm\", \"4 mm\"], passing = [0.3, 1]}\n";
  for (const Try& t :
       {Try{"ucs", good, {}}, Try{"bts", good, {}}, Try{"pack", sieves, {}},
        Try{"triaxial",
            filed + "[test]\nconfinement = [0, \"500 psi\", 1e6, \"2500 psi\", \"4000 psi\"]\n",
            {}},
        Try{"triaxial",
            filed,
            {"material.limit_compressive_stress=[1,2,3]", "test.confinement=[\"500 psi\"]"}},
        Try{"triaxial", good, {"material.fracture_energy_normal=3.3", "bonds.alpha=0.123456789012345678"}},
        Try{"ucs",
            pack + "[features]\nbreakage = false\nplasticity = false\n[material]\ndensity = 1\n"
                   "young_modulus = \"1 psi\"\npoisson_ratio = 0\nfriction_dynamic = 0\n",
            {}}}) {
    const Case once = load_case(folder.write("c.toml", t.text), t.sets, t.test);
    INFO(once.resolved);
    std::filesystem::create_directories(folder.path / "elsewhere");
    const Case again = load_case(folder.write("elsewhere/r.toml", once.resolved), {}, t.test);
    CHECK(without_notes(again.resolved) == without_notes(once.resolved));
    CHECK(again.test.confinement == once.test.confinement);
    CHECK(again.bonds.alpha == once.bonds.alpha);
    REQUIRE(again.materials.size() == once.materials.size());
    for (std::size_t i = 0; i < once.materials.size(); ++i) {
      CHECK(again.materials[i].young_modulus == once.materials[i].young_modulus);
      CHECK(again.materials[i].limit_compressive_stress == once.materials[i].limit_compressive_stress);
      CHECK(again.materials[i].fracture_energy_normal == once.materials[i].fracture_energy_normal);
      CHECK(again.materials[i].damage_normal == once.materials[i].damage_normal);
    }
  }
}

TEST_CASE("case: unknown keys, tables and presets are refused with the nearest valid one") {
  says(complaint(good + "densty = 1\n"),
       "c.toml:7: material.densty: unknown key; did you mean \"material.density\"?");
  says(complaint(good + "[test]\nstop_stain = 1\n"),
       "c.toml:8: test.stop_stain: unknown key; did you mean \"test.stop_strain\"?");
  says(complaint(good + "[run]\nplaten_speed = 1\n"),
       "c.toml:8: run.platen_speed: unknown key; did you mean \"test.platen_speed\"?");
  says(complaint(good + "[bonds]\nxyzzy = 1\n"),
       "c.toml:8: bonds.xyzzy: unknown key; valid: \"bonds.range\", \"bonds.coordination\"");
  says(complaint(good + "[bondz]\n"), "c.toml:7: bondz: unknown key; did you mean \"bonds\"?");
  says(complaint(good + "[[material.at]]\nconfinement = 0\ndelta = 1\n"),
       "c.toml:9: material.delta: unknown key; ");
  says(complaint(good + "[[material.at]]\nconfinement = 0\npreset = \"x\"\n"),
       "c.toml:9: material.at.preset: not for one confinement");
  for (const std::string line :
       {"law = \"kdem\"", "criterion = \"coupled\""})  // the tables and kernels are the series'
    says(complaint(good + "[[material.at]]\nconfinement = 0\n" + line + "\n"),
         "c.toml:9: material.at." + line.substr(0, line.find(' ')) +
             ": not for one confinement; it belongs to the whole material");
  says(complaint(good + "nu = 1\n"), "c.toml:7: material.nu: unknown key; valid: \"material.preset\", ");
  says(complaint(pack + "pack.size.kind = 1\n"),
       "c.toml:5: specimen.pack.size: unknown key; did you mean \"specimen.pack.sizes\"?");
  says(complaint("[a.b]\nc = 1\n"), "c.toml:1: a: unknown key; valid: \"specimen\", \"material\", \"bonds\"");
  says(complaint("\"a\\nb\" = 1\n"), "c.toml:1: a b: unknown key; ");
  says(complaint("bonds = 3\n" + good), "c.toml:1: bonds: a table is wanted: [bonds]");
  says(complaint(good + "[bonds.range]\nx = 1\n"), "c.toml:7: bonds.range: a number is wanted, not a table");
  says(complaint(pack + "[material]\npreset = \"concret\"\n"),
       "c.toml:6: material.preset: no preset \"concret\"; did you mean \"concrete\"? valid: ");
  says(complaint(pack + "[material]\npreset = \"../c\"\n"),
       "c.toml:6: material.preset: no preset \"../c\"; ");
  says(complaint(good, "ucs", {"bonds.rnage=1"}),
       "--set: bonds.rnage: unknown key; did you mean \"bonds.range\"?");
  says(complaint(good, "ucs", {"bonds.range"}), "--set: \"bonds.range\": write --set table.key=value");
  says(complaint(good, "ucs", {"=3"}), "--set: \"=3\": write --set table.key=value");
  says(complaint(good, "ucs", {"bonds.range=2"}), "--set: bonds.range: must be above -0.5 to below 1, not 2");
  says(complaint(good, "ucs", {"test.platen_speed=3 mm"}),
       "--set: test.platen_speed: \"3 mm\" is a length; a speed is wanted");
}

TEST_CASE("case: files that cannot be read, and text that is no TOML") {
  says(complaint(good + "[bonds]\nrange = \n"), "c.toml:8: not TOML: ");
  says(complaint(good + "preset = \"shale\"\n"), "c.toml:7: not TOML: ");
  const ScratchFolder folder;
  folder.write("case.toml", "");
  for (const auto& [name, text] :
       {std::pair{"caes.toml", "no such file; did you mean \"case.toml\"?"}, {"", "a folder, not a file"}}) {
    std::string line;
    try {
      load_case(folder.path / name, {}, "ucs");
    } catch (const BadInput& error) {
      line = error.what();
    }
    INFO(line);
    CHECK(line.find(text) != std::string::npos);
  }
  says(complaint(body + "file = \"sphere.csv\"\n"),
       "c.toml:4: specimen.file: no file \"sphere.csv\"; did you mean \"spheres.csv\"?");
  says(complaint(body + "file = \"far/away.csv\"\n"),
       "c.toml:4: specimen.file: no file \"far/away.csv\"; the path starts at the case's folder");
  says(complaint(body + "file = \"a.msh\"\n"),
       "c.toml:4: specimen.file: specimen type \".msh\" is not in this version; valid: \".csv\", \".mdpa\"");
  says(complaint(body + "file = \"a.lammps\"\n"),
       "c.toml:4: specimen.file: specimen type \".lammps\" is not in this version");
  says(complaint(body + "file = \"a.h5\"\n"),
       "c.toml:4: specimen.file: specimen type \".h5\" is not in this version");
  says(complaint(body + "file = \"a.xyz\"\n"), "c.toml:4: specimen.file: unknown specimen type \".xyz\"");
}

TEST_CASE("case: units and types are checked where the value stands") {
  says(complaint("[specimen]\ndiameter = \"150 Mm2\"\n"),
       "c.toml:2: specimen.diameter: \"150 Mm2\" is a quantity in m^2; a length is wanted");
  says(complaint("[specimen]\ndiameter = \"150 mn\"\n"),
       "c.toml:2: specimen.diameter: unknown unit \"mn\"; did you mean \"m");
  says(complaint("[specimen]\ndiameter = \"150\"\n"),
       "c.toml:2: specimen.diameter: \"150\" has no unit; write \"150 m\", or the bare number 150");
  says(complaint("[specimen]\ndiameter = true\n"),
       "c.toml:2: specimen.diameter: a length is wanted, a string with its unit or a bare number in m, not "
       "true");
  says(complaint("[specimen]\ndiameter = inf\n"), "c.toml:2: specimen.diameter: inf is not a finite number");
  says(complaint("[specimen]\ndiameter = nan\n"), "c.toml:2: specimen.diameter: nan is not a finite number");
  says(complaint("[specimen]\ndiameter = 1979-05-27\n"),
       "c.toml:2: specimen.diameter: a length is wanted, a string with its unit or a bare number in m, not a "
       "date");
  says(complaint("[specimen]\nshape = 1\n"),
       "c.toml:2: specimen.shape: a word is wanted, not 1; valid: \"cylinder\"");
  says(complaint("[specimen]\nshape = \"cilinder\"\n"),
       "c.toml:2: specimen.shape: unknown \"cilinder\"; did you mean \"cylinder\"?");
  says(complaint("[specimen]\nfile = \"\"\n"), "c.toml:2: specimen.file: a string is wanted");
  says(complaint("[specimen]\npack.spheres = 1.5\n"),
       "c.toml:2: specimen.pack.spheres: a whole number is wanted, not 1.5");
  says(complaint("[features]\nrotation = \"no\"\n"),
       "c.toml:2: features.rotation: true or false is wanted, not \"no\"");
  says(complaint("[bonds]\nalpha = \"atuo\"\n"),
       "c.toml:2: bonds.alpha: unknown \"atuo\"; did you mean \"auto\"?, or a number");
  says(complaint("[test]\nconfinement = [\"1 MPa\",\n  \"2 mm\"]\n"),
       "c.toml:3: test.confinement: \"2 mm\" is a length; a stress is wanted");
  says(complaint("[test]\nconfinement = []\n"), "c.toml:2: test.confinement: the list is empty");
  says(complaint("[specimen]\ncentre = [1, 2]\n"),
       "c.toml:2: specimen.centre: 3 values are wanted, [a, b, c]; 2 given");
  says(complaint("[material]\nlimit_compressive_stress = 3\n"),
       "c.toml:2: material.limit_compressive_stress: 3 values are wanted, [a, b, c]; 1 given");
  says(complaint("[material]\nat = 3\n"),
       "c.toml:2: material.at: write [[material.at]], once for each confinement");
}

TEST_CASE("case: ranges, each bound in the text") {
  struct Bound {
    const char *table, *line, *text;
  };
  for (const Bound& b : {
           Bound{"specimen", "diameter = 0", "must be more than 0 m, not 0 m"},
           {"specimen", "height = \"-1 mm\"", "must be more than 0 m, not -1 mm"},
           {"specimen", "pack.spheres = 0", "must be from 1 to 100000000, not 0"},
           {"specimen", "pack.porosity = 1", "must be from 0.02 to 0.6, not 1"},
           {"specimen", "pack.seed = -1", "must be at least 0, not -1"},
           {"specimen", "pack.sizes.spread = 1", "must be from 0 to 0.9, not 1"},
           {"specimen", "pack.sizes.openings = [\"4 mm\", \"2 mm\"]", "must rise: 2 mm stands behind 4 mm"},
           {"specimen", "pack.sizes.passing = [0.1, 1.1]", "must be from 0 to 1, not 1.1"},
           {"material", "density = 0", "must be more than 0 kg/m^3, not 0 kg/m^3"},
           {"material", "young_modulus = -1e9", "must be more than 0 Pa, not -1 GPa"},
           {"material", "poisson_ratio = 0.5", "must be from 0 to below 0.5, not 0.5"},
           {"material", "poisson_ratio = -0.1", "must be from 0 to below 0.5, not -0.1"},
           {"material", "friction_static = -1", "must be at least 0, not -1"},
           {"material", "friction_dynamic = -1", "must be at least 0, not -1"},
           {"material", "tensile_strength = 0", "must be more than 0 Pa, not 0 Pa"},
           {"material", "shear_strength = 0", "must be more than 0 Pa, not 0 Pa"},
           {"material", "limit_compressive_stress = [3e6, 2e6, 4e6]", "must rise: 2 MPa stands behind 3 MPa"},
           {"material", "limit_compressive_stress = [0, 2e6, 4e6]", "must be more than 0 Pa, not 0 Pa"},
           {"material", "stiffness_reduction = [1, 0.9, 1]", "must be at least 1, not 0.9"},
           {"material", "damage_normal = -0.1", "must be at least 0, not -0.1"},
           {"material", "damage_shear = -0.1", "must be at least 0, not -0.1"},
           {"material", "fracture_energy_normal = 0", "must be more than 0 J/m^2, not 0 J/m^2"},
           {"material", "fracture_energy_shear = 0", "must be more than 0 J/m^2, not 0 J/m^2"},
           {"bonds", "range = -0.5", "must be above -0.5 to below 1, not -0.5"},
           {"bonds", "range = 1", "must be above -0.5 to below 1, not 1"},
           {"bonds", "coordination = 0", "must be above 0 to below 30, not 0"},
           {"bonds", "alpha = 0", "must be more than 0, not 0"},
           {"damping", "contact = 1", "must be from 0 to below 1, not 1"},
           {"damping", "translation = -0.1", "must be from 0 to below 1, not -0.1"},
           {"damping", "rotation = 1", "must be from 0 to below 1, not 1"},
           {"test", "confinement = [\"-1 MPa\"]", "must be at least 0 Pa, not -1 MPa"},
           {"test", "platen_speed = 0", "must be more than 0 m/s, not 0 m/s"},
           {"test", "stop_strain = 0", "must be above 0 to below 1, not 0"},
           {"test", "stop_after_peak = 1", "must be from 0 to below 1, not 1"},
           {"time", "safety = 0", "must be above 0 to 1, not 0"},
           {"time", "safety = 1.1", "must be above 0 to 1, not 1.1"},
           {"time", "mass_factor = 1", "must be more than 1, not 1"},
           {"output", "frames = -1", "must be from 0 to 1000000, not -1"},
       }) {
    const std::string line = b.line, key = line.substr(0, line.find(' '));
    says(complaint(std::string("[") + b.table + "]\n" + line + "\n"),
         std::string("c.toml:2: ") + b.table + "." + key + ": " + b.text);
  }
  CHECK(complaint(good + "[time]\nsafety = 1\n") == "accepted");
  CHECK(complaint(good + "limit_compressive_stress = [2, 2, 2]\n") == "accepted");
}

TEST_CASE("case: a recipe of time.accuracy sets only what the case does not name") {
  const Case usual = load(good), normal = load(good + "[time]\naccuracy = \"normal\"\n");
  CHECK(normal.safety == usual.safety);
  CHECK(normal.damping.scheme == DampingScheme::explicit_);
  CHECK(!normal.mass_scaling);
  CHECK(normal.features.energy_ledger);
  const Case fast = load(good + "[time]\naccuracy = \"fast\"\n");
  CHECK(fast.damping.scheme == DampingScheme::summed);
  CHECK(fast.mass_scaling);
  CHECK(!fast.features.energy_ledger);
  const Case mine =
      load(good + "[damping]\nscheme = \"capped\"\n[time]\naccuracy = \"fast\"\nmass_scaling = false\n");
  CHECK(mine.damping.scheme == DampingScheme::capped);
  CHECK(!mine.mass_scaling);
  CHECK(mine.safety == fast.safety);
  CHECK(load(good + "[time]\naccuracy = \"reference\"\n").safety < usual.safety);
  says(complaint(good + "[time]\naccuracy = \"quick\"\n"),
       "c.toml:8: time.accuracy: unknown \"quick\"; valid: \"fast\", \"normal\", \"reference\"");
}

TEST_CASE("case: areas of the bonds - those of the strengths beside them") {
  for (const auto& [word, rule] : {std::pair{"minimum", AreaRule::minimum},
                                   {"harmonic", AreaRule::harmonic},
                                   {"polyhedron", AreaRule::polyhedron},
                                   {"voronoi", AreaRule::voronoi}}) {
    const std::string area = std::string("area = \"") + word + "\"\n";
    CHECK(load(good + "[bonds]\n" + area).bonds.area == rule);
    CHECK(!load(good + "[bonds]\n" + area).bonds.strength_area);
    const Case c = load(good + "[bonds]\nstrength_" + area);
    CHECK(c.bonds.strength_area == rule);
    CHECK(c.bonds.area == AreaRule::minimum);
  }
  CHECK(!load(good + "[bonds]\nstrength_area = \"same\"\n").bonds.strength_area);
  says(complaint(good + "[bonds]\narea = \"voronoy\"\n"),
       "c.toml:8: bonds.area: unknown \"voronoy\"; did you mean \"voronoi\"?");
}

namespace {

const std::string elastic_keys =
    "density = 2500\nyoung_modulus = \"28 GPa\"\npoisson_ratio = 0.2\n";  // lines 6 to 8
const std::string kdem = pack + "[material]\n" + elastic_keys +
                         "friction_dynamic = 0.25\nfriction_static = 0.9\ntensile_strength = \"5 MPa\"\n"
                         "shear_strength = \"16 MPa\"\nlaw = \"kdem\"\n";  // to line 13
const std::string glue = pack +
                         "[material]\ndensity = 2500\nlaw = \"contact-bond\"\nfriction_dynamic = 0.5\n"
                         "normal_stiffness = \"20 GN/m\"\nshear_stiffness = \"5 GN/m\"\n"
                         "normal_strength = \"8 kN\"\nbond_shear_strength = \"20 kN\"\n";

}  // namespace

TEST_CASE("case: law kdem has polyhedron areas and alpha 1 of its own - which the case may overrule") {
  const Case c = load(kdem);
  CHECK(c.bonds.area == AreaRule::polyhedron);
  CHECK(c.bonds.alpha_rule == AlphaRule::number);
  CHECK(c.bonds.alpha == 1);
  CHECK(c.materials.at(0).law == "kdem");
  CHECK(c.materials[0].own.at("normal_factor") == 1);
  CHECK(c.materials[0].own.at("shear_factor") == 1);
  const Case own = load(kdem + "normal_factor = 1.2\n[bonds]\narea = \"voronoi\"\nalpha = \"affine\"\n",
                        "triaxial", {"material.shear_factor=0.6"});
  CHECK(own.bonds.area == AreaRule::voronoi);
  CHECK(own.bonds.alpha_rule == AlphaRule::affine);
  CHECK(own.materials[0].own.at("normal_factor") == 1.2);
  CHECK(own.materials[0].own.at("shear_factor") == 0.6);
  says(complaint(kdem + "damage_normal = 0.1\n"),
       "c.toml:14: material.damage_normal: law \"kdem\" has no damage_normal; leave it out");
  says(complaint(kdem, "ucs", {"material.damage_normal=0.1"}),
       "--set: material.damage_normal: law \"kdem\" has no damage_normal; leave it out");
  says(complaint(kdem + "hardening_rate = 16\n"),
       "c.toml:14: material.hardening_rate: law \"kdem\" has no hardening_rate");
  says(complaint(good + "normal_factor = 1\n"),
       "c.toml:7: material.normal_factor: law \"dempack\" has no normal_factor");
}

TEST_CASE("case: what a preset has for another law is left out - of the resolved case too") {
  const Case c = load(good + "law = \"kdem\"\n", "ucs");  // the preset has delta_n = delta_s = 0.2
  CHECK(c.materials.at(0).damage_normal == 0);
  CHECK(c.materials[0].damage_shear == 0);
  CHECK(c.materials[0].tensile_strength == 5e6);
  CHECK(load(c.resolved, "ucs").resolved == c.resolved);
  const Case e = load(good + "law = \"exponential\"\n", "ucs");
  CHECK(e.materials.at(0).own.at("elastic_strain_limit") == 0.002);
  CHECK(e.materials[0].own.at("hardening_factor") == 0.2);
  CHECK(e.materials[0].own.at("hardening_rate") == 16);
  CHECK(e.materials[0].own.at("hardening_floor") == 0.275);
  CHECK(e.materials[0].damage_normal == 0.2);
  CHECK(e.bonds.area == AreaRule::minimum);
  CHECK(load(e.resolved, "ucs").resolved == e.resolved);
}

TEST_CASE("case: law contact-bond needs its four constants and two dimensions and has no area to scale") {
  says(complaint(glue),
       "c.toml:7: material.law: law \"contact-bond\" is one of discs; set specimen.dimensions = 2");
  says(complaint(glue + "[bonds]\nalpha = \"auto\"\n"),
       "c.toml:14: bonds.alpha: law \"contact-bond\" has stiffnesses of its own, no area to scale; leave it "
       "out");
  says(complaint(glue + "tensile_strength = 1\n"),
       "c.toml:13: material.tensile_strength: law \"contact-bond\" has no tensile_strength; leave it out");
  says(complaint(glue + "criterion = \"coupled\"\n"),
       "c.toml:13: material.criterion: law \"contact-bond\" has no criterion; leave it out");
  says(complaint(pack + "[material]\nnormal_strength = \"8 kPa\"\n"),
       "c.toml:6: material.normal_strength: \"8 kPa\" is a stress; a force is wanted");
  says(complaint(pack + "[material]\nnormal_stiffness = \"1 GPa\"\n"),
       "c.toml:6: material.normal_stiffness: \"1 GPa\" is a stress; ");
  says(complaint(pack + "[material]\nlaw = \"contact-bond\"\nnormal_stiffness = 0\n"),
       "c.toml:7: material.normal_stiffness: must be more than 0 ");
}

TEST_CASE("case: keys that a test does not know, and bodies that it does not test") {
  const std::string confined = good + "[test]\nconfinement = [0, \"4 MPa\"]\n";
  says(complaint(confined, "bts"), "c.toml:8: test.confinement: this test sets no pressure; leave it out");
  says(complaint(confined, "ucs"),
       "c.toml:8: test.confinement: 4 MPa: an unconfined test has none; leave it out, or use "
       "breccia-triaxial");
  CHECK(complaint(good + "[test]\nconfinement = [\"0 MPa\"]\n", "ucs") == "accepted");
  CHECK(complaint(confined, "ucs", {"test.confinement=0"}) == "accepted");
  CHECK(load(good, "bts").test.rough_platens == false);
  CHECK(load(good + "[test]\nplatens = \"rough\"\n", "bts").test.rough_platens);
  says(complaint(good + "[test]\nconfinement = 1\nplatens = \"rough\"\n", "shear"),
       "c.toml:9: test.platens: this test holds every direction; leave it out");
  for (const char* test : {"hydrostatic", "shear"}) {
    says(complaint(good, test), "c.toml: test.confinement: missing; give the ");
    says(complaint(good + "[test]\nconfinement = [\"1 MPa\", 0]\n", test),
         "c.toml:8: test.confinement: must be more than 0 Pa");
  }
  const auto shaped = [](const char* shape) {
    return body + "shape = \"" + shape + "\"\npack.spheres = 9\n[material]\npreset = \"shale\"\n";
  };
  says(complaint(shaped("disc"), "ucs"),
       "c.toml:4: specimen.shape \"disc\" does not go with breccia-ucs; valid: \"cylinder\", "
       "\"box\"");
  says(complaint(shaped("disc")),
       "c.toml:4: specimen.shape \"disc\" does not go with breccia-triaxial; valid: \"cylinder\"");
  says(complaint(shaped("cylinder"), "bts"),
       "c.toml:4: specimen.shape: a Brazilian test presses a disc; valid: \"disc\"");
  says(complaint(shaped("box"), "ucs"), "c.toml: specimen.depth: missing; a box has");
  says(complaint(good, "ucs", {"specimen.depth=1"}), "--set: specimen.depth: belongs to shape = \"box\"");
  CHECK(complaint(shaped("box"), "ucs", {"specimen.depth=1 m"}) == "accepted");
}

TEST_CASE("case: the specimen is named, once, with its size") {
  says(complaint("", "ucs"),
       "c.toml: specimen.file: missing; name a .csv or .mdpa file, or write [specimen.pack]");
  says(complaint("", "pack"), "c.toml: specimen.pack: missing; write [specimen.pack]");
  says(complaint("[specimen]\nfile = \"spheres.csv\"\n"), "c.toml: specimen.diameter: missing; ");
  says(complaint("[specimen]\nfile = \"spheres.csv\"\ndiameter = 1\n"), "c.toml: specimen.height: missing; ");
  says(complaint(pack + "file = \"spheres.csv\"\n"),
       "c.toml:4: specimen.pack.spheres: excludes specimen.file; give one of the two");
  says(complaint(body + "pack.seed = 3\n"),
       "c.toml: specimen.pack.spheres: missing; give the number of spheres");
  says(complaint(pack + "axis = \"y\"\n"),
       "c.toml:5: specimen.axis: a packing made here has its axis along z");
  says(complaint(pack + "centre = [0, 0, 0]\n"), "c.toml:5: specimen.centre: belongs to specimen.file");
  says(complaint(body + "file = \"spheres.csv\"\n", "pack"),
       "c.toml:4: specimen.file: breccia-pack makes the specimen; leave it out");
  CHECK(complaint(pack, "pack") == "accepted");
  CHECK(complaint(good, "pack") == "accepted");
  const std::string sieves = pack + "[specimen.pack.sizes]\nkind = \"sieves\"\n";
  says(complaint(sieves),
       "c.toml: specimen.pack.sizes.openings: missing; kind \"sieves\" has openings and passing");
  says(complaint(sieves + "openings = [1, 2]\npassing = [0.1]\n"),
       "c.toml:8: specimen.pack.sizes.passing: 1 values for 2 openings");
  says(complaint(sieves + "openings = [1, 2]\npassing = [0.1, 0.9]\n"),
       "c.toml:8: specimen.pack.sizes.passing: must end with 1, not 0.9");
  says(complaint(sieves + "openings = [2, 2]\npassing = [0.1, 1]\n"),
       "c.toml:7: specimen.pack.sizes.openings: two openings are equal");
  says(complaint(sieves + "openings = [1, 2]\npassing = [0.1, 1]\nspread = 0.1\n"),
       "c.toml:9: specimen.pack.sizes.spread: belongs to kind");
  says(complaint(pack + "pack.sizes.openings = [1, 2]\n"),
       "c.toml:5: specimen.pack.sizes.openings: belongs to kind = \"sieves\"");
}

TEST_CASE("case: a material is whole, or the missing key is named, features that are off ask for less") {
  says(complaint(pack), "c.toml: material.density: missing; give it, or a material.preset");
  const std::string elastic =
      pack + "[material]\ndensity = 1\nyoung_modulus = 1e9\npoisson_ratio = 0.2\nfriction_dynamic = 0\n";
  says(complaint(elastic),
       "c.toml: material.limit_compressive_stress: missing; give it, or a material.preset, or set "
       "features.plasticity = false");
  const std::string yielding =
      elastic + "limit_compressive_stress = [1, 2, 3]\nstiffness_reduction = [1, 2, 3]\n";
  says(complaint(yielding), "c.toml: material.friction_static: missing; ");
  const std::string strong = yielding + "friction_static = 0\ntensile_strength = 1\nshear_strength = 1\n";
  says(complaint(strong), "c.toml: material.damage_normal (or fracture_energy_normal): missing; ");
  CHECK(complaint(strong + "fracture_energy_normal = 1\ndamage_shear = 0\n") == "accepted");
  CHECK(complaint(yielding + "[features]\nbreakage = false\n") == "accepted");
  CHECK(complaint(elastic + "[features]\nbreakage = false\nplasticity = false\n") == "accepted");
  says(complaint(good + "damage_normal = 1\nfracture_energy_normal = 1\n"),
       "c.toml:8: material.fracture_energy_normal: excludes material.damage_normal; give one of the two");
  says(complaint(good + "[bonds]\nrange = 0.1\ncoordination = 10\n"),
       "c.toml:9: bonds.coordination: excludes bonds.range; give one of the two");
  says(complaint(good + "poisson_ratio = 0.3\n[bonds]\nelasticity = \"matched\"\n"),
       "c.toml:7: material.poisson_ratio: must be at most 0.25 with bonds.elasticity = \"matched\", not 0.3");
  CHECK(complaint(good + "poisson_ratio = 0.3\n") == "accepted");
}

TEST_CASE("case: a preset's faults are named by the preset's file and line, without a table") {
  const std::string with = pack + "[material]\npreset = ";
  says(complaint(with + "\"bad\"\n"),
       "materials/bad.toml:2: young_modulus: \"1 m\" is a length; a stress is wanted");
  says(complaint(with + "\"typo\"\n"),
       "materials/typo.toml:1: densty: unknown key; did you mean \"density\"?");
  says(complaint(with + "\"twice\"\n"), "materials/twice.toml:4: at: 5 Pa is given twice");
  says(complaint(with + "\"thin\"\n"), "c.toml: material.friction_dynamic: missing; give it");
}

TEST_CASE("case: [[material.at]] names a confinement that is run, once") {
  const std::string at = good + "[[material.at]]\n";
  says(complaint(at + "density = 1\n"), "c.toml:7: material.at: confinement is missing");
  says(complaint(at + "confinement = \"6 MPa\"\n"),
       "c.toml:8: material.at: no run has confinement 6 MPa; test.confinement has: 0 Pa");
  says(complaint(at + "confinement = 0\n[[material.at]]\nconfinement = 0\n"),
       "c.toml:10: material.at: 0 Pa is given twice; join the two tables");
  says(complaint(at + "confinement = \"6 mm\"\n"),
       "c.toml:8: material.at.confinement: \"6 mm\" is a length; a stress is wanted");
  says(complaint(at + "confinement = 0\n", "bts"), "c.toml:8: material.at: this test sets no pressure");
  CHECK(complaint(at + "confinement = \"6 MPa\"\n", "triaxial", {"test.confinement=\"7 MPa\""}) ==
        "accepted");
}

TEST_CASE("case: every declaration is whole, and the printed reference lists it") {
  for (const Key& key : all_keys()) {
    INFO(key.name);
    CHECK(find_key(key.name) == &key);
    CHECK(!key.meaning.empty());
    // parameters that one law alone has go to Material::own by their names
    CHECK((key.store != nullptr) + (key.store_material != nullptr) + !key.law.empty() == 1);
    CHECK((key.store == nullptr) == (key.name.starts_with("material.") && key.name != "material.preset"));
    const std::string word(key.name.substr(key.name.rfind('.') + 1));
    CHECK((describe_keys("triaxial").find("  " + word + " ") != std::string::npos) ==
          accepts(key, "triaxial"));
  }
  CHECK(describe_keys("bts").find("confinement  ") == std::string::npos);
  CHECK(describe_keys("pack").find("[bonds]") == std::string::npos);
}

TEST_CASE("case: a Brazilian test of a file must know the axis of the disc") {
  const ScratchFolder folder;
  std::ofstream(folder.path / "disc.csv") << "id,x_m,y_m,z_m,r_m\n1,0,0,0,1\n";
  const auto file = folder.path / "c.toml";
  const auto load_with = [&](const std::string& axis) {
    std::ofstream(file) << "[specimen]\nfile = \"disc.csv\"\ndiameter = 2\nheight = 2\n" + axis +
                               "[material]\npreset = \"concrete\"\n";
    return load_case(file, {}, "bts");
  };
  CHECK_THROWS_WITH_AS(load_with(""), doctest::Contains("specimen.axis: missing"), BadInput);
  CHECK(load_with("axis = \"z\"\n").specimen.axis == 'z');
}

TEST_CASE("case: the examples in data/cases load") {
  const std::filesystem::path cases = std::filesystem::path(BRECCIA_SOURCE_DIR) / "data/cases";
  CHECK(load_case(cases / "ucs-concrete.toml", {}, "ucs").specimen.pack->spheres == 4000);
  CHECK(load_case(cases / "ucs-concrete.toml", {}, "pack").specimen.body.diameter == 0.15);
  CHECK(load_case(cases / "triaxial-concrete.toml", {}, "triaxial").materials.size() == 4);
  const Case cement = load_case(cases / "triaxial-cement.toml", {}, "triaxial");
  CHECK(cement.specimen.body.diameter == 0.0254);
  CHECK(cement.specimen.body.height == 0.04826);
  CHECK(cement.materials.at(3).limit_compressive_stress == std::array{21e6, 23e6, 26e6});
}
